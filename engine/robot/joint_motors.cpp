#include "engine/robot/joint_motors.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/robot/joint_drive.h"

namespace pedicel::robot {

JointMotors::JointMotors(const RobotDescription& robot, const KinematicModel& model,
                         JointDrive& drive)
    : robot_(robot), model_(model), drive_(drive), commands_(model.dofs()) {}

int JointMotors::checked(int joint) const {
  if (joint < 0 || joint >= model_.dofs())
    throw UsageError("robot '" + robot_.name + "': joint index " + std::to_string(joint) +
                     ", expected 0 to " + std::to_string(model_.dofs() - 1));
  return joint;
}

void JointMotors::set_position_target(int joint, double position, double velocity) {
  JointCommand& command = commands_[checked(joint)];
  command.mode = ControlMode::position;
  command.position = std::clamp(position, model_.lower()[joint], model_.upper()[joint]);
  command.velocity = velocity;
}

void JointMotors::set_position_targets(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  for (int i = 0; i < model_.dofs(); ++i) set_position_target(i, q[i], qd[i]);
}

void JointMotors::set_velocity_target(int joint, double velocity) {
  JointCommand& command = commands_[checked(joint)];
  command.mode = ControlMode::velocity;
  command.velocity = velocity;
}

void JointMotors::set_torque(int joint, double torque) {
  JointCommand& command = commands_[checked(joint)];
  command.mode = ControlMode::torque;
  command.torque = torque;
}

void JointMotors::set_effort_limit(int joint, double effort) {
  checked(joint);
  if (!(effort > 0.0))
    throw UsageError("robot '" + robot_.name + "': effort limit of '" +
                     model_.joint_names()[joint] + "', expected more than 0");
  drive_.set_effort_limit(joint, std::min(effort, model_.effort_limits()[joint]));
}

double JointMotors::effort_limit(int joint) const {
  return drive_.effort_limit(checked(joint));
}

}  // namespace pedicel::robot
