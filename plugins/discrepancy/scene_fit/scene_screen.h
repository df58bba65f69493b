#pragma once

#include <limits>
#include <string>
#include <vector>

#include "plugins/discrepancy/scene_fit/scene_fit.h"

namespace pedicel::discrepancy {

/// A model extended by a cause, and what it would leave if it were linear.
struct ScreenedCause {
  std::string name;          ///< of the cause
  Hypothesis model;          ///< the base with the cause, free numbers where the linear puts them
  Eigen::VectorXd begun;     ///< unknowns of the base from which the linear went there
  double linear_cost = 0.0;  ///< nats, half the sum of squares that is left then
};

/// How large a cause would have to be to be seen beside the base's own numbers, as far as the
/// linear goes.
struct SeenFrom {
  std::string name, parameter, unit;
  effects::Vanishes vanishes = effects::Vanishes::never;
  double nominal = 0.0;  ///< the value with which it vanishes `at_nominal`
  /// In the number's own way from where it vanishes (a difference, a logarithm, an inverse), for
  /// one noise unit RMS; infinite where nothing shows it.
  double a_unit = std::numeric_limits<double>::infinity();
  /// Its value for so many noise units RMS; `at_nominal` the difference from it.
  double size(double noise_units) const;
};

/// All causes of scenes and of plants that `base` has not, at once: residuals of each at its starts
/// and the derivatives of its numbers there, side by side, on top of the base's own derivatives.
/// Effects of plants are also begun where the base's factors on the material are those of the
/// files. Best first. `seen`: how large each would have to be.
std::vector<ScreenedCause> screen_causes(SceneEvaluator& evaluator, const FitSummary& base,
                                         const std::vector<std::string>& has,
                                         const std::vector<int>& trials,
                                         std::vector<SeenFrom>* seen = nullptr);

}  // namespace pedicel::discrepancy
