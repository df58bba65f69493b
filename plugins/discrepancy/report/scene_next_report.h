#pragma once

#include <filesystem>
#include <string>

#include "engine/io/html_report.h"
#include "plugins/discrepancy/scene_next/scene_next.h"

namespace pedicel::discrepancy {

/// What each model predicts for the motion that parts them, drawn, and the motions that were tried
/// out. Nothing where none were.
void add_next_motion(io::HtmlReport& page, const SceneNext& next);

/// Writes the experiment with empty tables as `next/`: its scene, experiment.yaml, the joints or
/// commands of the motion, and in the trial's folder `predicted_NAME/` with the tables that each
/// model predicts, and predictions.svg. "next/experiment.yaml"; empty where there is none. Throws
/// io::WriteError; UsageError where the scene's files lie elsewhere than below its folder.
std::string write_scene_next(const std::filesystem::path& folder, const SceneNext& next);

}  // namespace pedicel::discrepancy
