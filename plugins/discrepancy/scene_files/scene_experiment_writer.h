#pragma once

#include <filesystem>

#include "plugins/discrepancy/scene/scene_experiment.h"

namespace pedicel::discrepancy {

/// The trials' tables and experiment.yaml, as a folder that read_scene_experiment() reads back; the
/// scene's own files are copied along: below `model` where they are not all below the scene's
/// folder. Throws io::WriteError, and UsageError where the scene's path leads out of the folder.
void write_scene_experiment(const std::filesystem::path& folder, const SceneExperiment& experiment);

}  // namespace pedicel::discrepancy
