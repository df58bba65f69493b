#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/test/statistics.h"

namespace pedicel::discrepancy {

/// What a baseline lacks may pull one of its factors away from what is known beforehand: a mass at
/// the tip raises density, and leaves little that linear changes about there could tell. These go
/// back step by step, a cause taking over bit by bit, so that the prediction never leaves the data
/// by a period (a continuation: Allgower and Georg 2003, Introduction to Numerical Continuation
/// Methods, chapter 2).

/// Whether a factor stands further from what is believed (`levels.believed`).
bool has_prior_shift(const Hypothesis& model, const DiagnosisSettings& settings);

/// Whether one stands so far away, or its modulus or density at a bound, that it is another plant.
/// (Damping that the data do not show ends at a bound, too.)
bool conflicts_with_prior(const FitSummary& model, const DiagnosisSettings& settings);

/// The same with its factors where they are believed to be.
Hypothesis at_prior(Hypothesis model);

/// The starts of a cause whose change looks like the pulled factor's own way back, the likest
/// first; empty where no factor is far enough away.
std::vector<Direction> likest_continuations(const FitSummary& base, const std::string& cause,
                                            const std::vector<Direction>& directions,
                                            const Budget& budget);

/// The base with that cause, the factors near what is believed, fitted at every step; nothing where
/// the cause loses the data on the way.
std::optional<FitSummary> continue_to_prior(Evaluator& evaluator, const FitSummary& base,
                                            const Direction& cause, const FitOptions& options);

}  // namespace pedicel::discrepancy
