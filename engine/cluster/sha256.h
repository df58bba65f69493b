#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pedicel::cluster {

/// 64 hexadecimal digits, as `sha256sum` prints them.
std::string sha256(std::string_view bytes);
/// Of a file's contents, whatever its size. Throws InvalidFile where it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace pedicel::cluster
