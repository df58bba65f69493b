#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/discrepancy/scene_fit/scene_fit.h"

namespace pedicel::discrepancy {

/// The baseline of a scene extended by causes, refitted in full.
struct SceneCandidate {
  std::vector<std::string> names;  ///< of the causes
  SceneFitResult fit;
  double cost = 0.0;    ///< nats: half the sum of squares, and 1/2 ln n for each number
  double excess = 0.0;  ///< noise units, RMS beyond the noise
};

struct SceneSearchOptions {
  std::vector<int> trials;
  int most_refits = 6;  ///< candidates refitted in full, a round
  int most_causes = 2;
  /// Noise units: what two honest solvers of such a scene differ by. A misfit below is none.
  double floor = 0.4;
  /// A cause must take so much of the mean square beyond the noise to be named at all.
  double least_share = 0.9;
  /// Nats as a share of what the best explains, within which another cause rivals it.
  double rival_share = 0.05;
  std::function<void(const std::string&, double)> progress;  ///< what is done, and its share
  const std::atomic<bool>* stop = nullptr;
};

struct SceneFindings {
  enum class Outcome { adequate, named, ambiguous, unknown };
  Outcome outcome = Outcome::adequate;
  double nominal_excess = 0.0;             ///< noise units, of the files' own model
  SceneFitResult baseline;                 ///< modulus, density and damping refitted
  double baseline_excess = 0.0;            ///< noise units
  std::vector<SceneCandidate> candidates;  ///< cheapest first
  /// Of a factor beside the causes, that left what is known of it: "youngs_modulus".
  std::vector<std::string> material;
  bool partial = false;  ///< it was stopped
};

/// Which cause explains what modulus, density and damping leave: every candidate is looked at in
/// the linear, the best are refitted in full.
SceneFindings search_scene(SceneEvaluator& evaluator, const SceneSearchOptions& options);

/// For people: the fits, and what they say.
std::string findings_text(const SceneFindings& findings, const SceneExperiment& experiment);

}  // namespace pedicel::discrepancy
