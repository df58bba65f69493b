#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pedicel/discrepancy/scene/scene_experiment.h"

namespace pedicel::discrepancy {

struct ExtendedScene {
  std::string file;               ///< name of the scene's file; empty: nothing in it would differ
  std::vector<std::string> left;  ///< effects that a scene has no words for
};

/// The scene as its numbers should be: effects of plants, contact and coupling stand in
/// extended.scene.yaml and the plant files beside it, which run like any other scene. The arm goes
/// through the joints of `trial` as they were read. What is the instruments' alone is left out.
ExtendedScene write_extended_scene(const std::filesystem::path& folder,
                                   const SceneExperiment& experiment,
                                   const std::vector<plant::Effect>& effects, int trial);

}  // namespace pedicel::discrepancy
