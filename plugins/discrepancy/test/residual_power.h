#pragma once

#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// What a residual holds of the plant's own motion beyond what noise would: a sign of something
/// that no cause's direction looks for.
struct ResidualPower {
  double deviations = 0.0;                 ///< of a standard normal
  double level = Levels{}.residual_power;  ///< that `deviations` must exceed
  int trial = -1;       ///< where it is strongest (`in_all`: the longest); -1: nowhere
  bool in_all = false;  ///< in all trials together, however little each shows
  double low_hz = 0.0, high_hz = 0.0;  ///< the band of it
  bool shows() const { return deviations > level; }
  std::string frequency() const;  ///< " at 1.4 Hz", " at 1.2 to 2.4 Hz"
};

/// Markers move in a few shapes, noise in all directions alike. The shapes are the largest
/// principal components of the markers' derivatives by the model's unknowns (`model.jacobian`); the
/// power of the whitened residual along them, over a single frequency or a band of octaves, is
/// compared with its power across them in the same neighbourhood, which has the noise's own colour;
/// samples count up to 4 noise units: an F test a band, by Wilson and Hilferty's cube roots
/// (Johnson, Kotz, Balakrishnan, Continuous Univariate Distributions 2, 27.4) as deviations of a
/// standard normal. `numerical` (noise units, may be empty) is our own error: its amplitude, twice,
/// is taken off that of the residual. The strongest of all bands, of each trial and of all
/// together; nothing for fewer markers than shapes to compare.
ResidualPower residual_power(const DataSet& data, std::span<const int> trials,
                             const FitSummary& model, const Eigen::VectorXd& numerical,
                             const DiagnosisSettings& settings);

}  // namespace pedicel::discrepancy
