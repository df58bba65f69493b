#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/scene/scene_experiment.h"

namespace pedicel::discrepancy {

/// True where the file is an experiment with `scene:`; false where it is none, or unreadable.
bool is_scene_experiment(const std::filesystem::path& path);

/// Reads an experiment folder (or its experiment.yaml) whose model is a scene. Every fault goes to
/// `diagnostics` with file, line and column; nothing comes back where there is one. `scene`: the
/// file of another scene to take in place of its own; what the experiment names must be there, too.
std::optional<SceneExperiment> read_scene_experiment(const std::filesystem::path& path,
                                                     Diagnostics& diagnostics,
                                                     const std::filesystem::path& scene = {});

}  // namespace pedicel::discrepancy
