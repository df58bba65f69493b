#include <algorithm>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

namespace {

/// The row before t and how far t is on the way to the next, 0 before the first and after the last.
struct Between {
  std::size_t row = 0;
  double share = 0.0;
};

Between between(const std::vector<double>& time, double t) {
  if (!(t > time.front())) return {};
  if (t >= time.back()) return {time.size() - 1, 0.0};
  const auto next = std::upper_bound(time.begin(), time.end(), t) - time.begin();
  const std::size_t row = static_cast<std::size_t>(next) - 1;
  return {row, (t - time[row]) / (time[row + 1] - time[row])};
}

}  // namespace

Vec3 DrivenPath::position_at(double t) const {
  const auto [row, share] = between(time, t);
  if (share == 0.0) return position[row];
  return (1.0 - share) * position[row] + share * position[row + 1];
}

Quat DrivenPath::rotation_at(double t) const {
  if (rotation.empty()) return Quat::Identity();
  const auto [row, share] = between(time, t);
  if (share == 0.0) return rotation[row];
  return rotation[row].slerp(share, rotation[row + 1]);
}

}  // namespace pedicel::discrepancy
