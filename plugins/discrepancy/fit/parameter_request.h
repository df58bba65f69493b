#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"

namespace pedicel::discrepancy {

/// What an effect may be asked for by.
struct EffectKind {
  const std::vector<effects::EffectParameter>* parameters = nullptr;
  bool needs_place = false;
};

/// Effects that an experiment can be fitted with.
struct FitVocabulary {
  std::vector<Cause> causes;  ///< with the values from which fits of them start
  /// Nothing where there is no effect of that name.
  std::function<std::optional<EffectKind>(const std::string& name)> kind;
};
/// Those of a single plant.
FitVocabulary plant_vocabulary(const Experiment& experiment);

/// The model that a fit is asked for, by names:
///   youngs_modulus, density, damping_time     a factor on the plant's own value
///   EFFECT.PARAMETER[@CURVE:AT]               free; of an effect, at a place
///   EFFECT.PARAMETER=VALUE[@CURVE:AT]         given (a word or a number)
/// Where the same effect stands at several places, a parameter without a place counts for all.
/// Comes back with the values from which a fit may start: those of a diagnosis.
/// Throws UsageError for names that are not known, for numbers that an effect needs and nothing
/// gives, and for places that the plant lacks.
std::vector<Hypothesis> requested_starts(const Experiment& experiment, const FitVocabulary& known,
                                         const std::vector<std::string>& words);
/// With the vocabulary of a single plant.
std::vector<Hypothesis> requested_starts(const Experiment& experiment,
                                         const std::vector<std::string>& words);

}  // namespace pedicel::discrepancy
