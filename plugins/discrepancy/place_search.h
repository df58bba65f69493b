#pragma once

#include "discrepancy/fit.h"

namespace pedicel::discrepancy {

/// Looks at other places on the curve of a fit's last effect, near and far, the other unknowns
/// moved along by the linear model, and goes on fitting from the best one while that is better: a
/// place lies in a narrow valley, along which fits stop too early. A fit without a free place comes
/// back as it is.
FitSummary slide_along(Evaluator& evaluator, FitSummary found, const FitOptions& options);

}  // namespace pedicel::discrepancy
