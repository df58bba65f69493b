#pragma once

#include <filesystem>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/robot/description.h"
#include "engine/world/scene.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

/// The scene that a log belongs to, with the files that it names.
struct LogScene {
  world::Scene scene;
  robot::RobotDescription robot;
  std::vector<plant::PlantFile> plants;  ///< by their names in the scene
  std::vector<std::string> joints;       ///< that move by themselves
  /// Its own file first, then all that an experiment carries along.
  std::vector<std::filesystem::path> files;
};

/// Throws InvalidFile with every fault; a scene without robot or plant files is one.
LogScene read_log_scene(const std::filesystem::path& file);

/// Copies the scene's files below `folder` as they lie to each other, so that relative names still
/// lead to them; returns the scene's path from there. Throws io::WriteError.
std::filesystem::path copy_scene(const LogScene& scene, const std::filesystem::path& folder);

}  // namespace pedicel::discrepancy
