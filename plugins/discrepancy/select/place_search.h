#pragma once

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// Looks at other places on the curve of a fit's last effect, or at other moments of one that
/// happens once (a slip), near and far, the other unknowns moved along by the linear model, and
/// goes on fitting from the best one while that is better: a place lies in a narrow valley, along
/// which fits stop too early; a moment has derivatives that see no farther than the next sample. A
/// fit without either comes back as it is.
FitSummary slide_along(Evaluator& evaluator, FitSummary found, const FitOptions& options);

}  // namespace pedicel::discrepancy
