#pragma once

#include <filesystem>

#include "app/report/run_watcher.h"

namespace pedicel::app {

/// What writes the moving scene of a run as a binary glTF file, at the frame rate of the scene's
/// video: links, bodies and fruits as nodes that move, stems and leaves as skins on the elements of
/// their rods, strings as skins on places along them. Where it has more than gltf_most_elements,
/// the run is refused (UsageError).
MakeWatcher gltf_film(const std::filesystem::path& file);

inline constexpr int gltf_most_elements = 60000;

}  // namespace pedicel::app
