#include "engine/io/xml_text.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "engine/core/utf8.h"

namespace pedicel::io {

namespace {

/// Behind the markup that begins at `start`: a comment, or a tag whose texts in quotes may hold a
/// '>'. `closes`: it is an element without content.
std::size_t end_of_markup(const std::string& text, std::size_t start, bool& closes) {
  if (text.compare(start, 4, "<!--") == 0) {
    const std::size_t end = text.find("-->", start + 4);
    return end == std::string::npos ? text.size() : end + 3;
  }
  char quote = '\0';
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      closes = text[i - 1] == '/';
      return i + 1;
    }
  }
  return text.size();
}

}  // namespace

bool is_xml_deeper(const std::string& text, int levels) {
  int depth = 0;
  for (std::size_t at = text.find('<'); at < text.size();) {
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    bool closes = false;
    const std::size_t end = end_of_markup(text, at, closes);
    if (next == '/')
      --depth;
    else if (next != '!' && next != '?' && !closes && ++depth > levels)
      return true;
    at = text.find('<', end);
  }
  return false;
}

std::string xml_in_utf8(std::string text, const std::string& file, Diagnostics& diagnostics) {
  SourcePosition here{file, 1, 1}, first;
  int replaced = 0;
  for (std::size_t i = 0; i < text.size();) {
    std::uint32_t code = 0;
    const std::size_t length = utf8_length(std::string_view(text).substr(i), code);
    if (length == 0) {
      if (replaced++ == 0) first = here;
      text[i] = '?';
    }
    here = text[i] == '\n' ? SourcePosition{file, here.line + 1, 1}
                           : SourcePosition{file, here.line, here.column + 1};
    i += std::max<std::size_t>(length, 1);
  }
  if (replaced > 0)
    diagnostics.warning(first, std::to_string(replaced) +
                                   (replaced == 1 ? " byte that is" : " bytes that are") +
                                   " no UTF-8, read as '?'");
  return text;
}

}  // namespace pedicel::io
