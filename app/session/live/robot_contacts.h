#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/session/live/snapshot.h"

namespace pedicel::app {

/// What a robot would run into at a pose: bodies, the ground, itself. Plants give way, and do not
/// count. Meshes count as their convex hulls, as in the simulation.
class RobotContacts {
 public:
  RobotContacts();
  ~RobotContacts();
  RobotContacts(const RobotContacts&) = delete;
  RobotContacts& operator=(const RobotContacts&) = delete;

  /// "link_5 into tray, link_2 into ground" for links at poses X_W; empty: nothing. What overlaps
  /// where the robot is now (a foot on its pedestal) is left out. Remembers the answer for a robot
  /// that is sent to the same goal.
  const std::string& at_goal(const Snapshot& now, const std::vector<Pose>& links);

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;  // of the stage below
  std::uint64_t stage_ = 0;
  Eigen::VectorXd goal_;  // that the answer is for
  std::string answer_;
};

}  // namespace pedicel::app
