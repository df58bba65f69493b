#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/verbs/experiment_run.h"
#include "app/verbs/observe.h"
#include "engine/core/diagnostics.h"

/// The verbs for experiments whose model is a scene: a robot at plants.
namespace pedicel::app {

/// For `pedicel validate`: reads and builds all of it; what it has in a sentence. Faults go to the
/// diagnostics.
std::string check_scene_experiment(const std::filesystem::path& path, Diagnostics& diagnostics);

/// `pedicel observe SCENE --like EXPERIMENT`, where the experiment is one of a scene. `model` is
/// a scene, or an experiment of one. Throws InvalidFile, UsageError, UnstableWorld, io::WriteError.
int observe_scene_verb(const ObserveArguments& arguments);

/// `pedicel diagnose` of such an experiment: verdict, report and extended scene go to `out`.
/// `with`: folders of trials that were done afterwards. `settings`: NAME=VALUE, of
/// discrepancy::SceneSettings. `time_limit`: s, after which the search ends and what is known is
/// told. Returns the exit code. Throws InvalidFile, UsageError, io::WriteError.
int diagnose_scene_verb(const ExperimentArguments& arguments, const std::vector<std::string>& with,
                        const std::vector<std::string>& settings, double time_limit);

/// `pedicel lab` of such an experiment. `truth`: a scene with its effects, or an experiment of one;
/// `set`: further effects of it, as in a file. Returns the exit code. Throws InvalidFile,
/// UsageError, UnstableWorld, io::WriteError.
int lab_scene_verb(const ExperimentArguments& arguments, const std::string& truth,
                   const std::vector<std::string>& set, int rounds);

}  // namespace pedicel::app
