#pragma once

#include "engine/robot/carried_links.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

/// Where a wrench of a robot is made: what a link exerts on what carries it. N and N m about the
/// origin of the link's frame, in that frame.
class LinkWrench {
 public:
  /// Before the first step that is asked for.
  LinkWrench(Simulation& simulation, int link);

  /// In the step that has ended, as a sensor at a wrist feels it: the weight of the link and of all
  /// that hangs on it, less what their motion takes, and what plants and rigid bodies exert on
  /// them. To be asked for once a step.
  robot::Wrench carried();
  /// In the step that has ended, as a sensor in a fingertip feels it: what plants and rigid bodies
  /// exert on the link.
  robot::Wrench touch();

 private:
  robot::Wrench felt(const std::vector<int>& by);

  Simulation& simulation_;
  robot::CarriedLinks links_;
  std::vector<robot::CarriedLinks::Momentum> momentum_;
  std::vector<robot::LinkReaction> forces_;
};

}  // namespace pedicel::simulation
