#pragma once

#include <span>
#include <vector>

#include "plugins/discrepancy/fit/fit.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"
#include "plugins/discrepancy/settings/scene_settings.h"
#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

/// Residuals of models of scenes over the same trials, side by side.
class SceneEvaluator : public ResidualSource {
 public:
  /// Keeps references to all three.
  SceneEvaluator(SceneSimulator& simulator, const SceneDataSet& data,
                 const SceneSettings& settings = default_scene_settings())
      : simulator_(simulator), data_(data), settings_(settings) {}

  /// Of whole records: `horizon` is not looked at.
  Eigen::MatrixXd residuals(std::span<const Hypothesis> models, const FitOptions& options) override;
  int size(std::span<const int> trials) const override;
  int samples(std::span<const int> trials, double horizon = 1.0) const override;
  FitStyle style(const Hypothesis& model) const override;
  /// `iterations` at most over these trials.
  FitOptions options(const std::vector<int>& trials, int iterations = 12) const;
  Misfit misfit(const Hypothesis& model, const std::vector<int>& trials);

  SceneSimulator& simulator() { return simulator_; }
  const SceneDataSet& data() const { return data_; }
  const SceneSettings& settings() const { return settings_; }

 private:
  SceneSimulator& simulator_;
  const SceneDataSet& data_;
  const SceneSettings& settings_;
};

/// fit(); what it leaves beyond the noise counts as noise of its numbers.
FitSummary fit_scene(SceneEvaluator& evaluator, const Hypothesis& start, const FitOptions& options);

/// Adds to the standard errors what predictions may be off by: `off` has a column, in units of the
/// noise over the residual's entries, for each reason; all of a column is off together.
void widen_errors(FitSummary& fit, const Eigen::MatrixXd& off);

/// Raises the standard errors to what stretches of the residual say that keep together: what a
/// model leaves keeps its sign for a while, and does not average out as white noise does (the
/// sandwich of clustered data; Liang and Zeger 1986). `stretch`: its number, of each entry.
void raise_errors(FitSummary& fit, std::span<const int> stretch);

/// Where data lie on the straight way between what two models foretell: 0 as one does, 1 as the
/// other.
struct Between {
  double at = 0.0;
  double error = 0.0;  ///< one deviation; infinite where both foretell the same
};
/// Of two fits to the same trials under the same noise.
Between between(const FitSummary& one, const FitSummary& other);

/// Modulus, density and damping of the plants, as factors on what their files say; and where a
/// plant stands, where nothing that was measured shows it but what it does to the arm.
Hypothesis scene_baseline(const Experiment& experiment,
                          const SceneSettings& settings = default_scene_settings());

}  // namespace pedicel::discrepancy
