#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// Where the fit of the baseline starts: of the factors on modulus, density and damping those that
/// these data can see (`unseen` gets the names of the others), at the best of several moduli over
/// the first part of the records.
Hypothesis baseline_start(Evaluator& evaluator, const FitOptions& options,
                          std::vector<std::string>& unseen);

/// Adds those of the `unseen` to a baseline, at their nominal values, that these data see plainly
/// after all: the noise was read from the data themselves, where a slow misfit may have passed for
/// noise with a long memory, and was read anew since. False where there are none.
bool add_plainly_seen(Evaluator& evaluator, const FitOptions& options,
                      std::vector<std::string>& unseen, Hypothesis& base);

}  // namespace pedicel::discrepancy
