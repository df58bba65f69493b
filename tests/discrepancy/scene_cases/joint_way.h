#pragma once

#include <vector>

#include "tests/discrepancy/scene_cases/scene_case.h"

namespace pedicel::scene_case {

/// Where a trial's joints are by their encoders: where they are told to be, or behind it where
/// their controller lags.
class JointWay {
 public:
  /// `dt`: s, of steps. Keeps a reference to the drive.
  JointWay(const Setting& setting, const Drive& drive, double dt);
  /// rad, rad, m. With a lag: at a multiple of the step, to half a step beyond the drive's end.
  Vec3 at(double t) const;

 private:
  const Drive& drive_;
  double dt_;
  std::vector<Vec3> lagged_;  // by step, from 0 on
};

}  // namespace pedicel::scene_case
