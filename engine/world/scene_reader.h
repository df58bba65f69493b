#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/world/scene.h"

namespace pedicel::io {
struct Key;
struct KeyList;
}  // namespace pedicel::io

namespace pedicel::world {

/// The keys of all maps of a scene file and of a file of what varies. They live as long as the
/// program.
std::vector<const io::KeyList*> scene_keys();
/// "body", "mass". Asserts that there is such a key.
const io::Key& scene_key(std::string_view map, std::string_view key);

/// Reads a scene file (`format: pedicel-scene`). Every fault goes to `diagnostics` with its line
/// and column; nothing comes back where there is one. Files that the scene names are looked for,
/// not read.
std::optional<Scene> read_scene(const std::filesystem::path& path, Diagnostics& diagnostics);

/// The same from text; `path` stands for the file in errors and for its folder in relative paths.
std::optional<Scene> parse_scene(const std::string& text, const std::filesystem::path& path,
                                 Diagnostics& diagnostics);

}  // namespace pedicel::world
