#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pedicel::io {

/// The longest text file that is read, bytes.
constexpr std::size_t longest_text = std::size_t{128} << 20;

/// Whether a text may be an export of motion capture, with several lines of names (see
/// kind_of_export()).
enum class CaptureExports { refused, taken };

/// Reads a text that people's programs wrote: a byte order mark is left out, UTF-16 with one comes
/// as UTF-8. Throws InvalidFile where the file cannot be read, is longer than `longest` (found out
/// before it is read), or is no text: what it is instead (a workbook, a compressed file, a web
/// page) is said where its first bytes tell.
std::string read_text_file(const std::filesystem::path& path, std::size_t longest = longest_text);

/// The same for bytes that are there already; `file` stands for them in errors.
std::string text_of_bytes(std::string bytes, const std::string& file,
                          CaptureExports exports = CaptureExports::refused);

/// A text without the byte order mark that it may begin with.
std::string_view without_mark(std::string_view text);

}  // namespace pedicel::io
