#pragma once

#include <string>
#include <string_view>

namespace pedicel::io {

/// A text as one cell of a table that we write. What would part cells or rows stands in quotes,
/// as RFC 4180 says; every other text is as it is.
inline std::string csv_cell(std::string_view text) {
  const bool outer_blank = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (!outer_blank && text.find_first_of(",;|\t\"\r\n") == std::string_view::npos)
    return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

}  // namespace pedicel::io
