#pragma once

#include <filesystem>
#include <string>

#include "engine/world/scene.h"
#include "plugins/simulation/simulation_options.h"

namespace pedicel::app {

/// `--save-plants`: every plant of a scene as a plant file of its own in a folder, each of a grid
/// with what its `vary` drew, and beside them the scene with these files in place of its grids, and
/// leaf templates that lay beside a plant. The scene runs to the same state hash. Returns a
/// sentence that says what was written. Throws InvalidFile for a faulty scene, and UsageError where
/// the folder has such files already, or effects of the scene name a grid.
std::string save_plants(const world::Scene& scene, const simulation::SimulationOptions& options,
                        const std::filesystem::path& folder);

}  // namespace pedicel::app
