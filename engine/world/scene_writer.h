#pragma once

#include <filesystem>
#include <string>

#include "engine/world/scene.h"

namespace pedicel::world {

/// A scene as a file: keys in the order of the format, what is as by default left out, numbers
/// exact, paths as seen from `folder` (empty: absolute), so that parse_scene() of it says the same
/// again. Throws UsageError for a body that the format has no words for.
std::string scene_text(const Scene& scene, const std::filesystem::path& folder);

/// The same without the plants: what else stands there, and how it is seen and judged.
std::string scene_text_without_plants(const Scene& scene, const std::filesystem::path& folder);

/// Whether a body is a tray of tray_parts(), and which (m).
bool is_tray(const BodyDescription& body, Vec3& size, double& wall);

}  // namespace pedicel::world
