#pragma once

#include <cmath>

#include "engine/core/random.h"
#include "plugins/discrepancy/simulate/noise.h"

namespace pedicel::discrepancy::testing {

/// A first-order autoregressive series of unit variance, stationary from its first sample.
inline Series coloured(Random& random, int size, double correlation) {
  Series e(size);
  const double innovation = std::sqrt(1.0 - correlation * correlation);
  e[0] = random.normal();
  for (int i = 1; i < size; ++i) e[i] = correlation * e[i - 1] + innovation * random.normal();
  return e;
}

/// Mean square.
inline double power(const Series& x) {
  return x.squaredNorm() / static_cast<double>(x.size());
}

/// Lag-one correlation of a series without mean.
inline double lag_one(const Series& x) {
  const Eigen::Index n = x.size() - 1;
  return x.head(n).dot(x.tail(n)) / x.squaredNorm();
}

}  // namespace pedicel::discrepancy::testing
