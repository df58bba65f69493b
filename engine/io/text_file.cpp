#include "engine/io/text_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include "engine/core/diagnostics.h"
#include "engine/core/files_read.h"
#include "engine/io/file_magic.h"

namespace pedicel::io {

namespace {

using namespace std::string_view_literals;

[[noreturn]] void too_long(const std::filesystem::path& path, std::size_t longest) {
  throw InvalidFile({path.string()}, "is longer than " + std::to_string(longest >> 20) +
                                         " MB, expected a shorter text: leave out columns or rows "
                                         "that are not needed");
}

// A pipe has no size, so what comes is counted as well.
std::string read_bytes(const std::filesystem::path& path, std::size_t longest) {
  note_file_read(path);
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InvalidFile({path.string()}, "is a folder, expected a file");
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size > longest) too_long(path, longest);
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InvalidFile({path.string()}, std::string("cannot be read: ") + std::strerror(errno));
  std::string bytes;
  std::array<char, 1 << 16> part;
  while (file.read(part.data(), part.size()) || file.gcount() > 0) {
    bytes.append(part.data(), static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > longest) too_long(path, longest);
  }
  return bytes;
}

void append_utf8(std::uint32_t code, std::string& out) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | (code >> 6));
    tail(0);
  } else if (code < 0x10000) {
    out += static_cast<char>(0xE0 | (code >> 12));
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0 | (code >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

std::string utf8_of_utf16(std::string_view bytes, bool big_end_first, const std::string& file) {
  if (bytes.size() % 2 != 0)
    throw InvalidFile({file}, "is UTF-16 with half a character at its end, expected a whole file");
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    const auto a = static_cast<unsigned char>(bytes[i]);
    const auto b = static_cast<unsigned char>(bytes[i + 1]);
    return big_end_first ? (a << 8) | b : (b << 8) | a;
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xD800 && code < 0xE000) {
      const bool pair =
          code < 0xDC00 && i + 3 < bytes.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000;
      if (!pair)
        throw InvalidFile({file}, "is broken UTF-16, expected UTF-8: save it again as UTF-8");
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    }
    append_utf8(code, text);
  }
  return text;
}

SourcePosition position_of(std::string_view text, std::size_t at, const std::string& file) {
  const std::string_view before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t start = before.find_last_of('\n');
  const std::size_t column = start == std::string_view::npos ? at + 1 : at - start;
  return {file, static_cast<int>(line), static_cast<int>(column)};
}

// The first byte that no text has: a control character other than tab, line ends and form feed.
void check_bytes(std::string_view text, const std::string& file) {
  const auto found = std::find_if(text.begin(), text.end(), [](unsigned char c) {
    return c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v';
  });
  if (found == text.end()) return;
  constexpr char digits[] = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(*found);
  const std::string name = {digits[byte >> 4], digits[byte & 0x0F]};
  throw InvalidFile(position_of(text, static_cast<std::size_t>(found - text.begin()), file),
                    "byte " + name + " (hex) is no text, expected a text file in UTF-8");
}

}  // namespace

std::string_view without_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF"sv) ? text.substr(3) : text;
}

std::string text_of_bytes(std::string bytes, const std::string& file, CaptureExports exports) {
  const std::string_view view = bytes;
  if (view.starts_with("\xFF\xFE\0\0"sv) || view.starts_with("\0\0\xFE\xFF"sv))
    throw InvalidFile({file}, "is UTF-32, expected UTF-8: save it as UTF-8");
  if (view.starts_with("\xFF\xFE"sv) || view.starts_with("\xFE\xFF"sv))
    bytes = utf8_of_utf16(view.substr(2), view[0] == '\xFE', file);
  else
    bytes.erase(0, view.size() - without_mark(view).size());
  if (const std::string other = kind_of_bytes(bytes); !other.empty())
    throw InvalidFile({file}, "is " + other);
  if (exports == CaptureExports::refused)
    if (const std::string other = kind_of_export(bytes); !other.empty())
      throw InvalidFile({file}, "is " + other);
  // What DOS and old editors end a text with.
  while (!bytes.empty() && (bytes.back() == '\x1A' || bytes.back() == '\0')) bytes.pop_back();
  check_bytes(bytes, file);
  return bytes;
}

std::string read_text_file(const std::filesystem::path& path, std::size_t longest) {
  return text_of_bytes(read_bytes(path, longest), path.string());
}

}  // namespace pedicel::io
