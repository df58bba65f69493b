#pragma once

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

/// Squares of residuals in units of the noise, and of how many samples: sums, so that kinds of
/// readings and trials can be added before a root is taken. A mean of roots would give a short
/// trial the weight of a long one.
struct Misfit {
  double square = 0.0;
  int count = 0;

  double rms() const { return count > 0 ? std::sqrt(square / count) : 0.0; }
  /// 1 is noise alone. Without samples nothing speaks against the model.
  double over_noise() const { return count > 0 ? rms() : 1.0; }
  /// Each sample of noise costs 1 on average in every model, so only what is above that can be
  /// shared out.
  double beyond() const { return std::max(0.0, square - count); }
  Misfit& operator+=(const Misfit& other) {
    square += other.square;
    count += other.count;
    return *this;
  }
};

}  // namespace pedicel::discrepancy
