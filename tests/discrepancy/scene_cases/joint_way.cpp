#include "tests/discrepancy/scene_cases/joint_way.h"

#include <algorithm>
#include <cmath>

namespace pedicel::scene_case {

JointWay::JointWay(const Setting& setting, const Drive& drive, double dt) : drive_(drive), dt_(dt) {
  const double lag = hidden_number(setting, "tracking_lag", "time", 0.0);
  if (lag <= 0.0) return;
  // lag x' + x = u, exact for a command u that goes evenly within a step. It begins at rest.
  const double kept = std::exp(-dt / lag);
  Vec3 x = drive.at(0.0);
  lagged_.push_back(x);
  const int steps = static_cast<int>(std::lround(drive.duration / dt)) + 1;
  for (int k = 1; k <= steps; ++k) {
    const Vec3 before = drive.at((k - 1) * dt), now = drive.at(k * dt);
    const Vec3 behind = lag * (now - before) / dt;
    x = now - behind + kept * (x - before + behind);
    lagged_.push_back(x);
  }
}

Vec3 JointWay::at(double t) const {
  if (lagged_.empty()) return drive_.at(t);
  const auto last = static_cast<long>(lagged_.size()) - 1;
  return lagged_[static_cast<std::size_t>(std::clamp(std::lround(t / dt_), 0L, last))];
}

}  // namespace pedicel::scene_case
