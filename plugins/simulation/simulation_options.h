#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "plugins/plant/plant_file.h"

namespace pedicel::simulation {

/// What a simulation is told beside its scene.
struct SimulationOptions {
  std::vector<std::string> packages;  ///< "NAME=PATH" of `--package`
  /// Taken in place of the files of the scene's plants, by their names in the scene (plants that
  /// are being edited). One without curves is left out.
  std::map<std::string, plant::PlantFile> edited = {};
  /// Where leaf templates are looked for beside the plants' own folders.
  std::vector<std::filesystem::path> leaf_folders = {};
};

}  // namespace pedicel::simulation
