#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
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

/// Cuts the next line off `text`, without its line end.
inline std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

/// A finite number that fills the whole cell.
inline std::optional<double> cell_number(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace pedicel::plant
