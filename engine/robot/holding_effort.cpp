#include "engine/robot/holding_effort.h"

#include <cmath>

#include "engine/io/csv.h"

namespace pedicel::robot {

std::optional<std::string> too_weak_to_hold(const RobotDescription& robot,
                                            const KinematicModel& model, const Eigen::VectorXd& q,
                                            const Vec3& gravity_W) {
  Dynamics dynamics(robot, model);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.dofs());
  const Eigen::VectorXd needed = dynamics.inverse(q, rest, rest, gravity_W);
  int worst = -1, count = 0;
  double largest = 1.0;
  for (int i = 0; i < model.dofs(); ++i) {
    const Joint& joint = robot.joints[robot.joint(model.joint_names()[i])];
    const double share = std::abs(needed[i]) / (model.effort_limits()[i] + joint.friction);
    if (share <= 1.0 + 1e-6) continue;
    ++count;
    if (share <= largest) continue;
    largest = share;
    worst = i;
  }
  if (worst < 0) return {};
  const Joint& joint = robot.joints[robot.joint(model.joint_names()[worst])];
  const std::string unit = joint.type == JointType::prismatic ? " N" : " N m";
  std::string text = "joint '" + joint.name + "' sags: to hold the robot at its start takes " +
                     io::format_number(std::abs(needed[worst]), 4) + unit + ", its effort is " +
                     io::format_number(model.effort_limits()[worst], 4) + unit;
  if (count > 1)
    text += " (" + std::to_string(count - 1) + " more joint" + (count > 2 ? "s" : "") +
            " of this kind)";
  return text;
}

}  // namespace pedicel::robot
