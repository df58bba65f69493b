#pragma once

#include <map>
#include <optional>
#include <string>

#include "plugins/discrepancy/select/verdict.h"

namespace pedicel::discrepancy {

/// What a sum of so many squared whitened residuals has above the noise; nothing where noise alone
/// may come to as much.
std::optional<double> above_noise(double square, double samples);

/// Residuals of the model that is told and of the refitted one.
struct MisfitSums {
  double refitted = 0.0, told = 0.0;  ///< sums of squares of the whitened ones
  double plain = 0.0;  ///< sum of squares of the told model's, in units of the noise of a sample
  double samples = 0.0;

  MisfitSums& operator+=(const MisfitSums& other);
};
/// By kind of instrument.
using InstrumentSums = std::map<std::string, MisfitSums>;

/// Without its symptoms. `fit`, `check`: of the trials that were fitted and of those held out.
LeftMisfit left_misfit(const InstrumentSums& fit, const InstrumentSums& check);

}  // namespace pedicel::discrepancy
