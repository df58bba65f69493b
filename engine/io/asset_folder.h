#pragma once

#include <filesystem>

namespace pedicel::io {

/// The folder of what Pedicel ships (scenes, robots, leaves), by where the program lies. Empty
/// where there is none.
std::filesystem::path asset_folder();

/// The same for a program at this path: `assets` of a checkout, or `share/pedicel/assets` where it
/// is installed, beside the program or above it.
std::filesystem::path asset_folder_of(const std::filesystem::path& program);

}  // namespace pedicel::io
