#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discrepancy/fit.h"

namespace pedicel::discrepancy {

/// Which of density, damping time and modulus must differ from their nominal values.
struct NeededParameters {
  std::vector<std::string> names;
  FitSummary model;  ///< refitted with the others at their nominal values
  /// Where modulus is needed and density could differ in its place, or the other way round (of a
  /// free swing the data see their ratio alone): the fit with that one.
  std::optional<FitSummary> exchanged;
};

/// Each in turn is put back to its nominal value and everything else refitted; it is needed where
/// that costs more than noise may. Where two of them say nearly the same (modulus and density of a
/// free swing), standard errors do not tell; the one that plants differ in less, put back first,
/// is not blamed alone.
NeededParameters needed_parameters(Evaluator& evaluator, const FitSummary& base,
                                   const FitOptions& options);

}  // namespace pedicel::discrepancy
