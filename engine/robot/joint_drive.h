#pragma once

#include <memory>
#include <vector>

#include "engine/robot/dynamics.h"
#include "engine/robot/joint_motors.h"
#include "engine/robot/joint_rows.h"
#include "engine/robot/multibody.h"

namespace pedicel::robot {

/// Turns commands into feed-forward torques and constraint rows of one step; see README, "Control".
class JointDrive {
 public:
  JointDrive(const RobotDescription& robot, const KinematicModel& model,
             const RobotSettings& settings, MultiBody& multibody);
  ~JointDrive();
  JointDrive(const JointDrive&) = delete;
  JointDrive& operator=(const JointDrive&) = delete;

  /// Before Bullet's step, with the robot at q, qd and `forces` on its links. Does not allocate.
  void begin(const std::vector<JointCommand>& commands, const Eigen::VectorXd& q,
             const Eigen::VectorXd& qd, std::span<const LinkForce> forces, double dt);
  /// rad or m: by how much the joints will be pushed back after the next step. Motors aim as much
  /// farther, so that they end where they were told to.
  void expect_recoil(const Eigen::VectorXd& recoil) { recoil_ = recoil; }
  void set_effort_limit(int dof, double effort) { effort_[dof] = effort; }
  double effort_limit(int dof) const { return effort_[dof]; }
  /// Motor torques of the step that just ended.
  void end(Eigen::VectorXd& torques) const;

 private:
  /// One joint that Bullet moves, with its rows (-1: none).
  struct Drive {
    const Joint* joint = nullptr;
    int dof = 0;
    std::size_t element = 0;  ///< of the model
    double multiplier = 1.0, offset = 0.0;
    int motor = -1;  ///< the row that couples it to its source for a mimic
    int damping = -1, friction = -1, limit = -1;
    double velocity = 0.0;  ///< expected at the end of the step
    double passive = 0.0;   ///< friction and damping at that velocity, N m or N
  };
  std::vector<JointRows::Row> lay_out(const RobotDescription& robot, const KinematicModel& model);
  void plan(const std::vector<JointCommand>& commands, const Eigen::VectorXd& q,
            const Eigen::VectorXd& qd, std::span<const LinkForce> forces);
  double planned_velocity(const JointCommand& command, int dof, double q) const;
  void drive_source(int k, const JointCommand& command);
  void drive_mimic(int k, const JointCommand& command);
  void set_passive_rows(const Drive& drive);
  void set_limit_row(int k);

  const KinematicModel& model_;
  const RobotSettings& settings_;
  MultiBody& multibody_;
  Dynamics dynamics_;
  std::vector<Drive> drives_;  // one for each joint of the multibody
  std::vector<int> source_;    // joint of the multibody of each degree of freedom
  std::unique_ptr<JointRows> rows_;
  double dt_ = 0.0;
  Eigen::VectorXd velocity_, acceleration_;  // planned, dofs
  Eigen::VectorXd recoil_;                   // expected, dofs
  Eigen::VectorXd effort_;                   // limits of the motors, dofs
  Eigen::VectorXd wanted_;                   // motor torque that the plan needs, dofs
  Eigen::VectorXd forward_;                  // of it, what the effort allows: applied ahead
};

}  // namespace pedicel::robot
