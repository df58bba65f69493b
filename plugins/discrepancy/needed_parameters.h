#pragma once

#include <string>
#include <vector>

#include "discrepancy/fit.h"

namespace pedicel::discrepancy {

/// Which of density, damping time and modulus must differ from their nominal values. Each in turn
/// is put back and everything else refitted; it is needed where that costs more than noise may.
/// Where two of them say nearly the same (modulus and density of a free swing), standard errors do
/// not tell, and the one that plants differ in less, put back first, is not blamed.
std::vector<std::string> needed_parameters(Evaluator& evaluator, const FitSummary& base,
                                           const FitOptions& options);

}  // namespace pedicel::discrepancy
