#include "plugins/discrepancy/simulate/first_order_lag.h"

#include <cmath>

namespace pedicel::discrepancy {

namespace {

// Integral of exp(-(s - r)/time) r^power over r from 0 to s. Where s is short against the time the
// closed form below would lose digits; there its series in s/time.
double forgotten(double time, double s, int power) {
  const double ratio = s / time;
  if (ratio < 0.5) {
    constexpr int terms = 14;
    double term = std::pow(s, power + 1) / (power + 1), sum = term;
    for (int j = 1; j < terms; ++j) sum += term *= -ratio / (power + 1 + j);
    return sum;
  }
  double value = -time * std::expm1(-ratio);
  for (int k = 1; k <= power; ++k) value = time * (std::pow(s, k) - k * value);
  return value;
}

}  // namespace

Vec3 lag_behind(const Vec3& before, double time, double s, const LagInput& input) {
  return std::exp(-s / time) * before + forgotten(time, s, 0) * input.constant +
         forgotten(time, s, 1) * input.linear + forgotten(time, s, 2) * input.square;
}

}  // namespace pedicel::discrepancy
