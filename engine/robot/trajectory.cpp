#include "engine/robot/trajectory.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel::robot {

namespace {

/// Slope at the inner of three rows: the weighted harmonic mean of the two secants, 0 at a turn.
double inner_slope(double h0, double h1, double secant0, double secant1) {
  if (secant0 * secant1 <= 0.0) return 0.0;
  const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / secant0 + w1 / secant1);
}

}  // namespace

Trajectory::Trajectory(std::vector<double> times, std::vector<Eigen::VectorXd> positions)
    : times_(std::move(times)), positions_(std::move(positions)) {
  if (times_.empty() || times_.size() != positions_.size())
    throw UsageError("Trajectory: expected as many rows as times, at least one");
  slopes_.assign(times_.size(), Eigen::VectorXd::Zero(positions_[0].size()));
  for (std::size_t i = 1; i < times_.size(); ++i)
    if (!(times_[i] > times_[i - 1]) || positions_[i].size() != positions_[0].size())
      throw UsageError("Trajectory: expected increasing times and rows of one length");
  for (std::size_t i = 1; i + 1 < times_.size(); ++i) {
    const double h0 = times_[i] - times_[i - 1], h1 = times_[i + 1] - times_[i];
    for (Eigen::Index k = 0; k < positions_[i].size(); ++k)
      slopes_[i][k] = inner_slope(h0, h1, (positions_[i][k] - positions_[i - 1][k]) / h0,
                                  (positions_[i + 1][k] - positions_[i][k]) / h1);
  }
}

void Trajectory::sample(double time, Eigen::VectorXd& q, Eigen::VectorXd& qd) const {
  PEDICEL_ASSERT(!times_.empty());
  if (time <= times_.front() || time >= times_.back()) {
    q = time <= times_.front() ? positions_.front() : positions_.back();
    qd.setZero(q.size());
    return;
  }
  const auto next = std::upper_bound(times_.begin(), times_.end(), time);
  const std::size_t i = static_cast<std::size_t>(next - times_.begin()) - 1;
  const double h = times_[i + 1] - times_[i], s = (time - times_[i]) / h;
  // Cubic Hermite basis and its derivative.
  const double p1 = s * s * (3.0 - 2.0 * s), m0 = s * (1.0 - s) * (1.0 - s), m1 = s * s * (s - 1.0);
  const double dp1 = 6.0 * s * (1.0 - s) / h;
  const double dm0 = (1.0 - s) * (1.0 - 3.0 * s), dm1 = s * (3.0 * s - 2.0);
  q = (1.0 - p1) * positions_[i] + p1 * positions_[i + 1] +
      h * (m0 * slopes_[i] + m1 * slopes_[i + 1]);
  qd = dp1 * (positions_[i + 1] - positions_[i]) + dm0 * slopes_[i] + dm1 * slopes_[i + 1];
}

}  // namespace pedicel::robot
