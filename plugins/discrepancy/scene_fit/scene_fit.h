#pragma once

#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"
#include "plugins/discrepancy/settings/scene_settings.h"
#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

struct SceneFitOptions {
  std::vector<int> trials;
  int iterations = 12;  ///< at most
};

/// A model of a scene fitted to some trials.
struct SceneFitResult {
  Hypothesis model;
  Eigen::VectorXd residual;        ///< in units of the noise, of all trials fitted
  Eigen::MatrixXd jacobian;        ///< of the prediction by the unknowns
  Eigen::VectorXd standard_error;  ///< of the unknowns, with what the model leaves as noise
  SceneDataSet::Sum sum;           ///< of the residual
  int evaluations = 0;             ///< simulations of all trials
  bool converged = false;
};

/// Residuals of models over the same trials, side by side.
class SceneEvaluator {
 public:
  /// Keeps references to all three.
  SceneEvaluator(SceneSimulator& simulator, const SceneDataSet& data,
                 const SceneSettings& settings = default_scene_settings())
      : simulator_(simulator), data_(data), settings_(settings) {}

  /// One column a model.
  Eigen::MatrixXd residuals(std::span<const Hypothesis> models, std::span<const int> trials);
  SceneDataSet::Sum sum(const Eigen::VectorXd& residual, std::span<const int> trials) const;
  SceneSimulator& simulator() { return simulator_; }
  const SceneDataSet& data() const { return data_; }
  const SceneSettings& settings() const { return settings_; }

 private:
  SceneSimulator& simulator_;
  const SceneDataSet& data_;
  const SceneSettings& settings_;
};

/// Bounded least squares (Ceres) from the model's values on.
SceneFitResult fit_scene(SceneEvaluator& evaluator, const Hypothesis& start,
                         const SceneFitOptions& options);

/// What a model predicts and how that changes with its unknowns, without a fit.
SceneFitResult look_at(SceneEvaluator& evaluator, const Hypothesis& model,
                       std::span<const int> trials);

/// Adds to the standard errors what predictions may be off by: `off` has a column, in units of the
/// noise over the residual's entries, for each reason; all of a column is off together.
void widen_errors(SceneFitResult& fit, const Eigen::MatrixXd& off);

/// Raises the standard errors to what stretches of the residual say that keep together: what a
/// model leaves keeps its sign for a while, and does not average out as white noise does (the
/// sandwich of clustered data; Liang and Zeger 1986). `stretch`: its number, of each entry.
void raise_errors(SceneFitResult& fit, std::span<const int> stretch);

/// Where data lie on the straight way between what two models foretell: 0 as one does, 1 as the
/// other.
struct Between {
  double at = 0.0;
  double error = 0.0;  ///< one deviation; infinite where both foretell the same
};
/// Of two fits to the same trials under the same noise.
Between between(const SceneFitResult& one, const SceneFitResult& other);

/// Modulus, density and damping of the plants, as factors on what their files say; and where a
/// plant stands, where nothing that was measured shows it but what it does to the arm.
Hypothesis scene_baseline(const Experiment& experiment,
                          const SceneSettings& settings = default_scene_settings());

}  // namespace pedicel::discrepancy
