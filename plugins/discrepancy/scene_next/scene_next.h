#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/scene_fit/scene_search.h"

namespace pedicel::discrepancy {

/// A motion of the arm that would tell competing models of a scene apart, and what each predicts.
struct SceneNext {
  struct Tried {
    std::string action;
    double apart = 0.0;              ///< noise units in all, of the nearest two as they are fitted
    std::optional<double> refitted;  ///< the same after both were refitted; of the best few
  };
  std::string sentence;            ///< what to do and what will be seen; empty: nothing to part
  std::vector<std::string> names;  ///< of the models, the likeliest first
  std::vector<Tried> tried;        ///< the best first
  /// The motion with empty tables, on the scene as it stands, and what each model predicts for it.
  /// Absent where no motion parts them.
  std::optional<Experiment> experiment;
  std::vector<SceneReadings> predictions;
  StatedNoise noise;  ///< of the instruments, as seen so far
  /// What differs most, for a drawing.
  struct Channel {
    std::string name, unit;
    std::vector<double> time;                 ///< s
    std::vector<std::vector<double>> series;  ///< one a model
    double noise = 0.0;                       ///< standard deviation of a sample
  } channel;
};

/// A model that may be the right one.
struct OpenModel {
  std::string name;
  const FitSummary* fit = nullptr;
};

/// Those that the findings leave open, the likeliest first: what competes with the best, and what
/// leaves no more than it may; where nothing explains the data, what came nearest. Fewer than two:
/// nothing is open.
std::vector<OpenModel> open_models(const SceneFindings& findings);

struct SceneNextOptions {
  SceneNumerics numerics;  ///< those that the models were fitted with
  SceneSettings settings;
  int threads = 1;
  int base = 0;                             ///< the trial that motions are made from
  const std::atomic<bool>* stop = nullptr;  ///< what is found is not to be used once it is set
};

/// Simulates motions of the arm for each of the models, and chooses the one that parts the first
/// of them best from the one nearest to it, both refitted. `data`: of the trials so far.
/// `simulations` counts what was simulated.
SceneNext next_scene_experiment(const Experiment& experiment, const SceneDataSet& data,
                                const std::vector<OpenModel>& models,
                                const SceneNextOptions& options, long& simulations);

}  // namespace pedicel::discrepancy
