#pragma once

#include <filesystem>
#include <string>

#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::discrepancy {

/// The report of a scene's diagnosis as one HTML page: the card, then measured against simulated
/// channels of every trial, the fits and the numbers.
std::string scene_report_text(const Experiment& experiment, const SceneDiagnosis& diagnosis);

/// The card for a terminal: what is wrong, how large, what it gains, what to do next.
std::string scene_card_text(const SceneDiagnosis& diagnosis);

/// Sentences of the card: on what it was decided, what is gained, and what to do next.
std::string scene_certainty_text(const SceneDiagnosis& diagnosis);
std::string scene_gain_text(const SceneDiagnosis& diagnosis);
std::string scene_next_text(const Verdict& verdict);

/// Writes it as report.html into the folder. Throws io::WriteError.
void write_scene_report(const std::filesystem::path& folder, const Experiment& experiment,
                        const SceneDiagnosis& diagnosis);

}  // namespace pedicel::discrepancy
