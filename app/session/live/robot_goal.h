#pragma once

#include <optional>
#include <vector>

#include "app/session/live/snapshot.h"
#include "engine/robot/kinematics.h"

namespace pedicel::app {

/// Where the tool was asked to go, and what became of it.
struct ToolGoal {
  Pose asked_W;    ///< X_W of the tool
  Pose nearest_W;  ///< X_W, where it goes; the same where that can be reached
  bool reached = true;
  std::string sentence;  ///< "unreachable: ..."; empty where it can be reached
};

/// Where each link will be once the robot has done what it was told.
struct RobotGhost {
  std::vector<Pose> links;  ///< X_W, as RobotSnapshot::links
  Pose tool;                ///< X_W
};

/// Kinematics of the robot of a snapshot. Throws UsageError where there is none.
robot::KinematicModel kinematics_of(const Snapshot& now);
/// What a move by hand starts from (rad or m): where the robot is sent by hand, else where it is; a
/// program ends with the move.
const Eigen::VectorXd& start_of(const RobotSnapshot& robot);
/// X_W of the tool at joint positions.
Pose tool_at(const Snapshot& now, const robot::KinematicModel& model, const Eigen::VectorXd& q);
/// Degrees of freedom that move the tool, without the gripper's.
int tool_freedom(const Snapshot& now, const robot::KinematicModel& model);

/// The robot at its goal; nothing where it is there (but for 0.02 rad or 3 mm of any joint that
/// moves the tool), where there is no robot, and while a program goes on for ever.
std::optional<RobotGhost> robot_ghost(const Snapshot& now);

}  // namespace pedicel::app
