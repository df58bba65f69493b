#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/robot/carried_links.h"

namespace pedicel::robot {

/// A force (N) on a link at a point (m), world frame.
struct LinkForce {
  int link = 0;
  Vec3 force_W = Vec3::Zero(), point_W = Vec3::Zero();
};

/// Inverse dynamics and energy of a description with a resting base, without Bullet: the recursive
/// Newton-Euler algorithm (Luh, Walker, Paul 1980; Featherstone 2008, section 5.3) in world axes.
/// Does not allocate after construction.
class Dynamics {
 public:
  Dynamics(const RobotDescription& robot, const KinematicModel& model);

  /// What each degree of freedom must be driven with (N m or N) so that the robot at q, qd
  /// accelerates with qdd under gravity and `forces`; the share of mimic joints is included, joint
  /// damping and friction are not.
  const Eigen::VectorXd& inverse(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                                 const Eigen::VectorXd& qdd, const Vec3& gravity_W,
                                 std::span<const LinkForce> forces = {});

  /// The same for each element of the model (mimic joints by themselves), from the last inverse().
  const std::vector<double>& element_torques() const { return element_torques_; }

  /// What a link and all that hangs on it exert on what carries them in the last inverse(): N and
  /// N m about the link's origin, in its frame.
  Wrench carried_wrench(int link) const;

  /// Joint-space mass matrix (kg, kg m, kg m2; dofs x dofs), one column an inverse() without
  /// motion.
  const Eigen::MatrixXd& mass_matrix(const Eigen::VectorXd& q);

  double kinetic_energy(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);  ///< J
  double potential_energy(const Eigen::VectorXd& q, const Vec3& gravity_W);    ///< J

 private:
  struct LinkState {
    Vec3 angular_acceleration, acceleration;  // of the frame's origin, world axes
    Vec3 force, moment;                       // through the joint, moment about the frame's origin
  };
  void forward(const Eigen::VectorXd& qd, const Eigen::VectorXd& qdd);
  void own_forces(const Vec3& gravity_W);
  void backward();

  KinematicModel model_;
  std::vector<Inertial> inertials_;
  std::vector<Pose> poses_;
  std::vector<Twist> twists_;
  std::vector<LinkState> states_;
  std::vector<double> element_torques_;
  Eigen::VectorXd torques_, resting_, one_;
  Eigen::MatrixXd mass_;
};

}  // namespace pedicel::robot
