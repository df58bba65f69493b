#include "discrepancy/held_out.h"

#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double least_change = 3.0;  // noise units in all
// Of the expected gain: with a change d and a residual d a + noise, the gain over the expected one
// is 2 a - 1, so 0.2 stands for an amplitude a of 0.6. Its standard deviation is 2 / |d|.
constexpr double least_share = 0.2;
constexpr double deviations = 2.0;

}  // namespace

bool HeldOut::carries_over() const {
  const double change = std::sqrt(2.0 * expected);
  if (change < least_change) return true;
  return gain > (least_share - deviations * 2.0 / change) * expected;
}

HeldOut held_out(const Eigen::VectorXd& base, const Eigen::VectorXd& extended, double dispersion) {
  return {0.5 * (base.squaredNorm() - extended.squaredNorm()) / dispersion,
          0.5 * (base - extended).squaredNorm() / dispersion};
}

}  // namespace pedicel::discrepancy
