#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/core/diagnostics.h"
#include "engine/core/utf8.h"

namespace pedicel {

namespace {

constexpr std::size_t short_text = 60;  ///< bytes of a cell or a name within a sentence

// Controls of both kinds, what turns the direction of writing, line separators, a BOM.
bool is_hidden(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x200B && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
}

void escape(unsigned char byte, std::string& out) {
  constexpr char digits[] = "0123456789ABCDEF";
  switch (byte) {
    case '\n':
      out += "\\n";
      return;
    case '\r':
      out += "\\r";
      return;
    case '\t':
      out += "\\t";
      return;
    default:
      out += {'\\', 'x', digits[byte >> 4], digits[byte & 0x0F]};
  }
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0 || length > text.size()) return 0;
  constexpr std::array<unsigned char, 5> lead = {0, 0x7F, 0x1F, 0x0F, 0x07};
  code = first & lead[length];
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = (code << 6) | (byte(i) & 0x3F);
  }
  constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= least[length] && code < 0x110000 && !surrogate ? length : 0;
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t length = utf8_length(text, code);
    if (out.size() + std::max<std::size_t>(length, 1) > longest) return out + "...";
    if (length > 0 && !is_hidden(code))
      out += text.substr(0, length);
    else
      for (std::size_t i = 0; i < std::max<std::size_t>(length, 1); ++i)
        escape(static_cast<unsigned char>(text[i]), out);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string in_quotes(std::string_view text) {
  return '"' + printable(text, short_text) + '"';
}

}  // namespace pedicel
