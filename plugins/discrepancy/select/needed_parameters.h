#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// Which of density, damping time and modulus must differ from their nominal values.
struct NeededParameters {
  std::vector<std::string> names;
  FitSummary model;  ///< refitted with the others at their nominal values
  /// What could differ in place of one that is needed: density of modulus, or the other way round
  /// (of a free swing the data see their ratio alone), another law of damping of the damping time
  /// (where one mode swings). The fits with these, named.
  struct Instead {
    FitSummary model;
    double behind = 0.0;  ///< nats by which it explains the data worse than what is needed
  };
  std::vector<Instead> instead;

  /// The best of these, where it explains the data better than what is needed; else null.
  const FitSummary* better() const;
};

/// Each in turn is put back to its nominal value and everything else refitted; it is needed where
/// that costs more than noise may. Where two of them say nearly the same (modulus and density of a
/// free swing), standard errors do not tell; the one that plants differ in less, put back first,
/// is not blamed alone. None is needed where the held-out trials (`check`, may be empty) are
/// clearly against all of them. `causes` are all that are known.
NeededParameters needed_parameters(Evaluator& evaluator, const FitSummary& base,
                                   const std::vector<Cause>& causes, const FitOptions& options,
                                   const std::vector<int>& check = {});

}  // namespace pedicel::discrepancy
