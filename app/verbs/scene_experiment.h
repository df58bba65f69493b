#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/verbs/experiment_run.h"
#include "app/verbs/observe.h"
#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/fit/fit_parts.h"

/// The verbs for experiments whose model is a scene: a robot at plants.
namespace pedicel::app {

/// For `pedicel validate`: builds all of it; what it has in a sentence. Faults go to the
/// diagnostics.
std::string check_scene_experiment(const discrepancy::Experiment& experiment,
                                   Diagnostics& diagnostics);

/// observed() of an experiment with a robot: `like` has the scene to simulate. Throws UsageError,
/// UnstableWorld.
discrepancy::Experiment observed_scene(const ObserveArguments& arguments,
                                       const discrepancy::Experiment& like);

/// `pedicel diagnose` of such an experiment: verdict, report and extended scene go to `out`.
/// `settings`: NAME=VALUE, of discrepancy::SceneSettings. `time_limit`: s, after which the search
/// ends and what is known is told. `parts`: who does refits; null: this program. Returns the exit
/// code. Throws UsageError, io::WriteError.
int diagnose_scene(const ExperimentArguments& arguments, const discrepancy::Experiment& experiment,
                   const std::vector<std::string>& settings, double time_limit,
                   discrepancy::FitParts* parts);

/// `pedicel lab` of such an experiment. `truth`: a scene with its effects, or an experiment of one;
/// `set`: further effects of it, as in a file. Returns the exit code. Throws InvalidFile,
/// UsageError, UnstableWorld, io::WriteError.
int lab_scene(const ExperimentArguments& arguments, discrepancy::Experiment experiment,
              const std::string& truth, const std::vector<std::string>& set, int rounds);

}  // namespace pedicel::app
