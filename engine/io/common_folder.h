#pragma once

#include <filesystem>
#include <span>

namespace pedicel::io {

/// The deepest folder that all of `files` are in or below; at least one, all absolute.
std::filesystem::path common_folder(std::span<const std::filesystem::path> files);

}  // namespace pedicel::io
