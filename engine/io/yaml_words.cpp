#include "engine/io/yaml_words.h"

#include <charconv>
#include <cmath>
#include <string_view>

namespace pedicel::io {

namespace {

bool is_plain(const std::string& text) {
  static constexpr std::string_view letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  static constexpr std::string_view inside = "0123456789 .-";
  if (text.empty() || letters.find(text.front()) == std::string_view::npos) return false;
  if (text.back() == ' ' || text == "null" || text == "Null" || text == "NULL") return false;
  for (const char c : text)
    if (letters.find(c) == std::string_view::npos && inside.find(c) == std::string_view::npos)
      return false;
  return true;
}

}  // namespace

std::string yaml_number(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value < 0.0 ? "-.inf" : ".inf";
  char buffer[40];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  std::string text(buffer, end);
  const std::size_t mark = text.find('e');
  if (mark == std::string::npos) return text;
  std::string power = text.substr(mark + 1);  // with its sign
  while (power.size() > 2 && power[1] == '0') power.erase(1, 1);
  const std::string digits = text.substr(0, mark);
  return digits + (digits.find('.') == std::string::npos ? ".0e" : "e") + power;
}

std::string yaml_quoted(const std::string& text) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20 || code == 0x7f)
      quoted += std::string("\\x") + digits[code >> 4] + digits[code & 15];
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string yaml_word(const std::string& text) {
  return is_plain(text) ? text : yaml_quoted(text);
}

}  // namespace pedicel::io
