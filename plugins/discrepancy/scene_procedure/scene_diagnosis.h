#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "plugins/discrepancy/scene_fit/scene_search.h"
#include "plugins/discrepancy/scene_next/scene_next.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/settings/scene_settings.h"

namespace pedicel::discrepancy {

struct SceneDiagnosisOptions {
  /// Mesh and step of the predictions that are judged; those of the search are coarser.
  SceneNumerics numerics;
  SceneSettings settings;
  int threads = 1;
  FitParts* parts = nullptr;  ///< does refits of causes; null: they are done here
  double time_limit = std::numeric_limits<double>::infinity();  ///< s
  std::function<void(const std::string&, double)> progress;
  const std::atomic<bool>* stop = nullptr;
  /// Called where a stop has ended the search; it takes the stop back, and what is known is written
  /// down as at the time limit. Empty: a stop ends everything.
  std::function<void()> cut_short;
};

/// What was found out of a measured scene.
struct SceneDiagnosis {
  SceneFindings findings;
  Verdict verdict;
  std::vector<int> fit_trials, check_trials;
  /// By trial: as the files say, refitted, and extended (the refitted one where nothing was found).
  std::vector<SceneReadings> nominal, refitted, extended;
  std::vector<plant::Effect> model;  ///< the extended one, on top of the files
  std::string text;                  ///< the fits, for people
  SceneNext next;                    ///< the motion that parts what is left open
};

/// Which trials are fitted and which held out: as the experiment says; where it says nothing, of
/// three trials or more the one with the second largest misfit (`misfit`, by trial) is held out.
void split_scene_trials(const Experiment& experiment, const std::vector<double>& misfit,
                        std::vector<int>& fit, std::vector<int>& check);

/// The whole procedure: noise of the predictions, baseline, causes, held-out trials, verdict.
SceneDiagnosis diagnose_scene(const Experiment& experiment, const SceneDiagnosisOptions& options);

}  // namespace pedicel::discrepancy
