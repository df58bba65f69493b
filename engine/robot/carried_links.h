#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/robot/kinematics.h"

namespace pedicel::robot {

/// A force (N) and a moment (N m).
using Wrench = Eigen::Matrix<double, 6, 1>;

/// A force (N) and a moment (N m) about its point (m) on a link, world frame.
struct LinkReaction {
  int link = 0;
  Vec3 force_W = Vec3::Zero(), point_W = Vec3::Zero(), moment_W = Vec3::Zero();
};

/// A link and all that hangs on it: what they weigh on what carries them.
class CarriedLinks {
 public:
  CarriedLinks(const RobotDescription& robot, int link);

  int link() const { return links_.front(); }
  const std::vector<int>& links() const { return links_; }
  bool contain(int link) const;

  struct Momentum {
    Vec3 linear = Vec3::Zero();   ///< kg m/s, W
    Vec3 angular = Vec3::Zero();  ///< kg m2/s, W, about the link's centre of mass
  };
  /// Of links(), from the poses and velocities of all links.
  std::vector<Momentum> momentum(const std::vector<Pose>& X_WL,
                                 const std::vector<Twist>& twists) const;
  /// Their weight, less what a step of `dt` (s) takes in which their momentum changes from `before`
  /// to `now`: N and N m about the link's origin, in its frame; `X_WL` at the end of the step.
  Wrench weight(const std::vector<Pose>& X_WL, const std::vector<Momentum>& before,
                const std::vector<Momentum>& now, double dt, const Vec3& gravity_W) const;
  /// What they pass on of forces on the robot's links: those on other links do not count. N and N m
  /// about the link's origin, in its frame.
  Wrench felt(const std::vector<Pose>& X_WL, std::span<const LinkReaction> forces) const;

 private:
  std::vector<int> links_;           // the link first
  std::vector<Inertial> inertials_;  // of links_
};

}  // namespace pedicel::robot
