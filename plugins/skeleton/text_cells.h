#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace pedicel::plant {

/// One cell of a line, without the blanks around it.
struct TextCell {
  std::string_view text;
  int column = 1;  ///< of its first character, from 1; a tab counts as one
};

inline std::vector<TextCell> split_cells(std::string_view line, char separator) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<TextCell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(separator, start), line.size());
    std::string_view text = line.substr(start, end - start);
    const std::size_t lead = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(lead);
    text.remove_suffix(text.size() - (text.find_last_not_of(blanks) + 1));
    cells.push_back({text, static_cast<int>(start + lead) + 1});
    start = end + 1;
  }
  return cells;
}

/// Cuts the next line off `text`, without its line end (LF, CR LF or CR).
inline std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
  return line;
}

}  // namespace pedicel::plant
