#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/fit_parts.h"
#include "plugins/discrepancy/scene_fit/outside_force.h"
#include "plugins/discrepancy/scene_fit/scene_fit.h"
#include "plugins/discrepancy/scene_fit/scene_screen.h"

namespace pedicel::discrepancy {

/// The baseline of a scene extended by causes, refitted in full.
struct SceneCandidate {
  std::vector<std::string> names;  ///< of the causes
  FitSummary fit;
  double cost = 0.0;    ///< nats: half the sum of squares, and 1/2 ln n for each number
  double excess = 0.0;  ///< noise units, RMS beyond the noise
  std::optional<double> check_excess;  ///< the same on trials held out
};

/// A model that was refitted and judged with another mesh than the search has.
struct FinerFit {
  FitSummary fit;
  double excess = 0.0;                 ///< noise units, RMS beyond the noise
  std::optional<double> check_excess;  ///< the same on trials held out
};

struct SceneSearchOptions {
  std::vector<int> trials;  ///< to be fitted
  std::vector<int> check;   ///< held out
  int threads = 1;
  FitParts* parts = nullptr;  ///< does refits of causes; null: they are done here, one by one
  std::function<void(const std::string&, double)> progress;  ///< what is done, and its share
  std::function<bool()> stop;  ///< true: what is known so far is to be concluded
  /// Takes the predictions' own noise anew, at a model (widen_noise()); none: it stays.
  std::function<void(const std::vector<plant::Effect>&)> renew_noise;
  /// m, W: by how much farther the tool pushes than a model says, by wrenches (push_shift()); none:
  /// it is not known.
  std::function<Vec3(const std::vector<plant::Effect>&)> push_shift;
  /// Refits a model with the mesh that judges; none: the search's own is as fine.
  std::function<FinerFit(const Hypothesis&)> refit_finely;
};

struct SceneFindings {
  enum class Outcome { adequate, named, ambiguous, unknown };
  Outcome outcome = Outcome::adequate;
  double nominal_excess = 0.0;                          ///< noise units, of the files' own model
  FitSummary baseline;                                  ///< modulus, density and damping refitted
  double baseline_cost = 0.0;                           ///< nats, as a candidate's
  double baseline_excess = 0.0;                         ///< noise units
  std::optional<double> nominal_check, baseline_check;  ///< the same on trials held out
  std::vector<SceneCandidate> candidates;               ///< those with causes, the best first
  std::vector<std::size_t> competing;  ///< with the best: candidates that do nearly as well
  /// Of a number beside the causes, that left what is known of it: "youngs_modulus", "plant_pose".
  std::vector<std::string> material;
  std::vector<SeenFrom> seen;  ///< how large each cause would have to be, beside the baseline
  double seen_units = 0.0;     ///< noise units that a cause must make to be looked for
  OutsideForce outside;        ///< where nothing explains the data
  std::vector<int> clean;      ///< trials that the baseline alone explains, likewise
  bool partial = false;        ///< it was stopped

  bool explained() const { return outcome == Outcome::named || outcome == Outcome::ambiguous; }
  /// The model that is told: with the causes, or the baseline.
  const FitSummary& model() const {
    return explained() && !candidates.empty() ? candidates.front().fit : baseline;
  }
};

/// Which cause explains what modulus, density and damping leave: all are looked at in the linear at
/// once, the best are refitted in full, further ones are looked for on top where one does not do.
SceneFindings search_scene(SceneEvaluator& evaluator, const SceneSearchOptions& options);

/// For people: the fits, and what they say.
std::string findings_text(const SceneFindings& findings, const Experiment& experiment);

/// "contact_friction and payload".
std::string joined_names(const std::vector<std::string>& names);

}  // namespace pedicel::discrepancy
