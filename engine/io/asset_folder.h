#pragma once

#include <filesystem>
#include <string>

namespace pedicel::io {

/// The folder of what Pedicel ships (scenes, robots, leaves), by where the program lies. Empty
/// where there is none.
std::filesystem::path asset_folder();

/// The same for a program at this path: `assets` of a checkout, or `share/pedicel/assets` where it
/// is installed, beside the program or above it.
std::filesystem::path asset_folder_of(const std::filesystem::path& program);

/// A file to read, or an experiment folder, by the name that it has in a checkout:
/// "assets/scenes/NAME.scene.yaml", "plants/NAME.plant.yaml", "assets/experiments/NAME". One of
/// that name that is there comes first, then the one that ships with these assets; where neither
/// is, the name stays as it is.
std::string shipped_file(const std::string& name, const std::filesystem::path& assets);
/// The same with asset_folder().
std::string shipped_file(const std::string& name);

}  // namespace pedicel::io
