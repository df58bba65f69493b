#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

struct ExtendedScene {
  std::string file;               ///< name of the scene's file; empty: nothing in it would differ
  std::vector<std::string> left;  ///< effects of instruments that a run of the scene does not have
};

/// The scene as it should be: effects of contact, arm and sensors stand among the `effects:` of
/// extended.scene.yaml, those of plants in the plant files beside it. It runs like any other scene.
/// The arm goes through the joints of `trial` as they were read, or gets its commands. What cameras
/// do is left out.
ExtendedScene write_extended_scene(const std::filesystem::path& folder,
                                   const Experiment& experiment,
                                   const std::vector<plant::Effect>& effects, int trial);

}  // namespace pedicel::discrepancy
