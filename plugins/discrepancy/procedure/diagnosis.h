#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "plugins/discrepancy/admission/admission.h"
#include "plugins/discrepancy/fit/numerics.h"
#include "plugins/discrepancy/force/missing_force.h"
#include "plugins/discrepancy/procedure/next_experiment.h"
#include "plugins/discrepancy/select/candidates.h"
#include "plugins/discrepancy/select/stalk_strength.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/test/statistics.h"

namespace pedicel::discrepancy {

struct DiagnosisOptions {
  int threads = 1;
  std::uint64_t seed = 1;
  /// What is being done, and the share of the whole that is done (an estimate); from any thread.
  std::function<void(const std::string&, double)> progress;
  std::function<void(const std::string&)> note;  ///< each finding, as a sentence
  const std::atomic<bool>* stop = nullptr;
  double time_limit = std::numeric_limits<double>::infinity();  ///< s, of the search
  /// Called once where `stop` or the time limit cut the search short. Then what is known is
  /// concluded, and the verdict is `partial`. Without it a diagnosis that is stopped is not
  /// complete.
  std::function<void()> cut_short;
  DiagnosisSettings settings = {};
  FitParts* parts = nullptr;  ///< does the first fits of candidates; null: they are done here
};

/// The three models that a diagnosis compares.
enum Model { nominal, refitted, extended };
inline constexpr int model_count = 3;

/// Everything that a diagnosis found out, for its report.
struct Diagnosis {
  Verdict verdict;
  DiagnosisSettings settings = {};  ///< that it was made with
  Admission admission;
  Noise position_noise, force_noise;
  Numerics numerics;
  double numerical_error = 0.0;  ///< RMS over the noise, before it was corrected for
  std::vector<int> fit_trials, check_trials;
  std::string exchanged;  ///< a trial that was to be held out, and was fitted because it objects
  std::vector<std::string> unseen;  ///< parameters that these data cannot see
  FitSummary base, best;            ///< refitted and extended
  std::vector<Candidate> ranking;   ///< first round, best first
  Alarm before, after;
  std::vector<Direction> directions;
  /// [model][trial]; of `extended` as refitted where no cause was found.
  std::array<std::vector<Prediction>, model_count> predictions;
  MissingForce force;              ///< where the outcome is unknown
  StalkStrength strength;          ///< where it was recorded when fruits came off
  NextExperiment next;             ///< empty where there is none
  std::vector<std::string> steps;  ///< what was done, one sentence each
  bool stopped = false;            ///< the caller asked for it, and the rest is not complete
};

/// The procedure of the folder's README, from the data to the verdict. Throws InvalidFile where the
/// plant cannot be built.
Diagnosis diagnose(const Experiment& experiment, const DiagnosisOptions& options);

/// The nominal plant with what was found: refitted factors and causes that belong to the plant.
plant::PlantFile extended_plant(const Experiment& experiment, const Hypothesis& hypothesis);

}  // namespace pedicel::discrepancy
