#pragma once

#include <string>

#include "engine/world/scene.h"

namespace pedicel::app {

/// A scene file that says what is run, for `--print-scene`: the scene's own text with the options
/// and overrides in it, the numbers that it left to their defaults, and paths from the root, so
/// that it runs wherever it is put, to the same state hash. Throws UsageError where the text cannot
/// be changed so (aliases), or the scene is made of a plant that has no plant file.
std::string effective_scene(const world::Scene& scene);

}  // namespace pedicel::app
