#pragma once

#include <string>
#include <vector>

#include "pedicel/discrepancy/scene_fit/scene_fit.h"

namespace pedicel::discrepancy {

/// A model extended by a cause, and what the linear promises of it.
struct ScreenedCause {
  std::string name;       ///< of the cause
  Hypothesis model;       ///< the base with the cause, free numbers where the linear puts them
  double promised = 0.0;  ///< nats, half the sum of squares that the linear expects
};

/// All causes of scenes and of plants that `base` has not, at once: residuals of each at its starts
/// and the derivatives of its numbers there, side by side, on top of the base's own derivatives.
/// Best first.
std::vector<ScreenedCause> screen_causes(SceneEvaluator& evaluator, const SceneFitResult& base,
                                         const std::vector<std::string>& has,
                                         std::span<const int> trials);

}  // namespace pedicel::discrepancy
