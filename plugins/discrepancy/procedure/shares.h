#pragma once

#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/select/findings.h"

namespace pedicel::discrepancy {

/// How much of the misfit each cause of the verdict explains, and how far it moves what is
/// measured. J is the sum of squared whitened residuals, and N the number of samples.
///
/// - Modulus, density and damping that are off stand beside the other causes.
/// - `share` of a cause is (J_without - J_all) / (J_nominal - N). `all` is the model with every
///   cause. `without` has all others, refitted where they are and at half to twice their size, so
///   that none becomes the one that is missing. Modulus, density and damping that are no causes are
///   the same in both.
/// - `change` is the RMS of what these two models predict differently.
/// - Causes are sorted by share. What explains too little becomes a detail.
///
/// Refits the best model once for each cause, and three times to find the parameters that are off.
/// Does nothing unless the outcome is `named` or `ambiguous`.
void tell_shares(Evaluator& evaluator, const Findings& findings, const FitOptions& options,
                 Diagnosis& diagnosis);

/// What the verdict's model leaves of the data, from the diagnosis's predictions: the verdict's
/// `left`. After it is known whether causes are named.
void tell_left(const Findings& findings, Diagnosis& diagnosis);

}  // namespace pedicel::discrepancy
