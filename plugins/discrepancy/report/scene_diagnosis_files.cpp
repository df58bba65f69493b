#include "plugins/discrepancy/report/scene_diagnosis_files.h"

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/report/scene_next_report.h"
#include "plugins/discrepancy/report/scene_report.h"
#include "plugins/discrepancy/scene_procedure/extended_scene.h"

namespace pedicel::discrepancy {

void write_scene_diagnosis(const std::filesystem::path& folder, const Experiment& experiment,
                           SceneDiagnosis& diagnosis) {
  Verdict& verdict = diagnosis.verdict;
  const bool is_found = verdict.outcome == Outcome::adequate || verdict.outcome == Outcome::named ||
                        verdict.outcome == Outcome::ambiguous;
  if (is_found && !diagnosis.model.empty()) {
    const int trial = diagnosis.fit_trials.empty() ? -1 : diagnosis.fit_trials.front();
    const ExtendedScene extended = write_extended_scene(folder, experiment, diagnosis.model, trial);
    verdict.extended_scene = extended.file;
    if (std::filesystem::exists(folder / "extended.plant.yaml"))
      verdict.extended_plant = "extended.plant.yaml";
    for (const std::string& left : extended.left)
      diagnosis.text += "  extended.scene.yaml is without " + left + "\n";
  }
  try {
    verdict.next = write_scene_next(folder, diagnosis.next);
  } catch (const UsageError& fault) {
    // The verdict stands without it.
    std::filesystem::remove_all(folder / "next");
    diagnosis.text += std::string("  no next/: ") + fault.what() + "\n";
  }
  io::write_file_atomically(folder / "findings.txt", diagnosis.text);
  io::write_file_atomically(folder / "verdict.json", to_json(verdict) + "\n");
  write_scene_report(folder, experiment, diagnosis);
}

}  // namespace pedicel::discrepancy
