#pragma once

#include <string>
#include <vector>

#include "discrepancy/causes.h"
#include "discrepancy/fit.h"

namespace pedicel::discrepancy {

/// Where the fit of the baseline starts: of the factors on modulus, density and damping those that
/// these data can see (`unseen` gets the names of the others), at the best of several moduli over
/// the first part of the records.
Hypothesis baseline_start(Evaluator& evaluator, const FitOptions& options,
                          std::vector<std::string>& unseen);

}  // namespace pedicel::discrepancy
