#pragma once

#include <filesystem>

#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::discrepancy {

/// Writes what was found of a measured scene into a folder that is there: report.html,
/// verdict.json, findings.txt, the extended scene and the motion that decides, where there are
/// such. What it writes beside stands in the diagnosis's verdict afterwards. Throws io::WriteError.
void write_scene_diagnosis(const std::filesystem::path& folder, const Experiment& experiment,
                           SceneDiagnosis& diagnosis);

}  // namespace pedicel::discrepancy
