#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// A motion of the arm that could be done next.
struct MotionDesign {
  /// With the joints or the commands that do it, and the instruments' sample times; nothing in
  /// their tables is measured (NaN).
  Trial trial;
  std::string action;  ///< "turn wrist by 90 degrees, then do as in push_1"
};

/// Motions made from a trial that was measured: at other speeds, with other swings, with a wrist
/// turned before or after, with a hold where it goes farthest, from the plant's other side, and
/// away from plants. Those that the arm may not go (WayCheck) are left out; plain ones stand first.
std::vector<MotionDesign> motion_designs(const Experiment& experiment, int trial);

}  // namespace pedicel::discrepancy
