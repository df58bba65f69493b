#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

/// The model that a fit is asked for, by names:
///   youngs_modulus, density, damping_time     a factor on the plant's own value
///   EFFECT.PARAMETER[@CURVE:AT]               free; of an effect, at a place
///   EFFECT.PARAMETER=VALUE[@CURVE:AT]         given (a word or a number)
/// Where the same effect stands at several places, a parameter without a place counts for all.
/// Comes back with the values from which a fit may start: those of a diagnosis.
/// Throws UsageError for names that are not known, for numbers that an effect needs and nothing
/// gives, and for places that the plant lacks.
std::vector<Hypothesis> requested_starts(const Experiment& experiment,
                                         const std::vector<std::string>& words);

}  // namespace pedicel::discrepancy
