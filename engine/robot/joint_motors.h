#pragma once

#include <vector>

#include "engine/robot/kinematics.h"

namespace pedicel::robot {

class JointDrive;

enum class ControlMode { position, velocity, torque };

/// What one degree of freedom is told to do.
struct JointCommand {
  ControlMode mode = ControlMode::position;
  double position = 0.0;  ///< rad or m
  double velocity = 0.0;  ///< rad/s or m/s
  double torque = 0.0;    ///< N m or N
};

/// What the motors of a robot's joints are told. Commands stay until changed; targets outside the
/// limits are moved into them. Indices of joints are the model's; others throw UsageError.
class JointMotors {
 public:
  /// Keeps references.
  JointMotors(const RobotDescription& robot, const KinematicModel& model, JointDrive& drive);

  /// Where the joint shall be at the end of the next step, and how fast it moves there.
  void set_position_target(int joint, double position, double velocity = 0.0);
  /// The same for all joints (a sample of a Trajectory at the end of the next step).
  void set_position_targets(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  void set_velocity_target(int joint, double velocity);
  void set_torque(int joint, double torque);
  ControlMode mode(int joint) const { return commands_[checked(joint)].mode; }
  /// Limits what a motor may apply (N m or N; a gripper that must not crush): never more than the
  /// URDF's effort. Throws UsageError where it is not positive.
  void set_effort_limit(int joint, double effort);
  double effort_limit(int joint) const;

  const std::vector<JointCommand>& commands() const { return commands_; }
  /// The index, if there is such a joint. Throws UsageError.
  int checked(int joint) const;

 private:
  const RobotDescription& robot_;
  const KinematicModel& model_;
  JointDrive& drive_;
  std::vector<JointCommand> commands_;
};

}  // namespace pedicel::robot
