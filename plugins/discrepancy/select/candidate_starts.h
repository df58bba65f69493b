#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit.h"
#include "plugins/discrepancy/test/statistics.h"

namespace pedicel::discrepancy {

/// Where refits of a candidate start. `base` is the model that it extends.

/// The base with a cause's start; `from_nominal`: with the parameters' factors at 1.
Hypothesis joined(const Hypothesis& base, const Hypothesis& start, bool from_nominal);

/// Whether a place is among what is free.
bool has_place(const Hypothesis& hypothesis);

/// The step of a model's unknowns that changes the prediction as `wanted` does, as far as bounds
/// and what is known beforehand allow: along a valley (modulus and density of a free vibration) the
/// data would let it go anywhere.
Eigen::VectorXd allowed_step(const FitSummary& model, const Eigen::VectorXd& wanted,
                             const DiagnosisSettings& settings);

/// The best `keep` of a cause's own starts and of those that symptoms give (sizes, places, from the
/// refitted and from the nominal parameters), by a look at the first part of the records.
std::vector<Hypothesis> best_starts(Evaluator& evaluator, const FitSummary& base,
                                    const Cause& cause, FitOptions options, std::size_t keep);

/// A cause's linear starts that are worth a fit: the size that the data give to its directions, the
/// base's numbers moved along. The best by cost over the whole records, or, because places are
/// apart by ridges, those of every place.
std::vector<Hypothesis> best_linear_starts(Evaluator& evaluator, const FitSummary& base,
                                           const std::string& cause,
                                           const std::vector<Direction>& directions,
                                           const FitOptions& options);

/// The starts of a cause with the values of one that is a special case of it, as `fitted` on top of
/// the base; with little of what the cause has more (a gust's `amplitude`).
std::vector<Hypothesis> continued(const Hypothesis& base, const Hypothesis& fitted,
                                  const Cause& cause, double amplitude);

/// What a fit may miss because it says nearly the same in other words: an anisotropy of an upright
/// stem turned by a right angle, its ratio the other way round and the modulus stiffer by it. Of
/// branches it is another plant, behind a ridge. Nothing for other causes.
std::optional<Hypothesis> twin_of(const Hypothesis& fitted);

/// The best of all starts of a cause as they are, where it does better than the base: what is large
/// no linear model sees. A threshold is looked for between them, too.
std::optional<Hypothesis> best_plain_start(Evaluator& evaluator, const FitSummary& base,
                                           const Cause& cause, const FitOptions& options);

/// What was fitted by another simulator, its threshold where this one puts it, the other numbers as
/// they are: the sharpest bend of a coarse mesh is another one than a fine mesh's, and a threshold
/// just beyond it does nothing, however it is moved. Causes without a threshold stay as fitted.
Hypothesis with_threshold_by(Evaluator& evaluator, const Hypothesis& fitted, const Cause& cause,
                             const FitOptions& options);

}  // namespace pedicel::discrepancy
