#pragma once

#include <Eigen/Dense>

#include "engine/robot/trajectory.h"

namespace pedicel::simulation {

/// A trajectory that a robot follows from a time of the world on, and after it a lap over and over
/// where there is one. The lap should end where it begins.
class FollowedProgram {
 public:
  FollowedProgram() = default;
  /// `start`: s of the world at which the lead's time is 0. An empty lap: there is none.
  FollowedProgram(robot::Trajectory lead, robot::Trajectory lap, double start)
      : lead_(std::move(lead)), lap_(std::move(lap)), start_(start) {}

  bool empty() const { return lead_.empty(); }
  bool loops() const { return !lap_.empty(); }
  /// s, since the lead or the lap at hand began.
  double time(double world_time) const;
  /// s that the lead or the lap at hand takes.
  double duration(double world_time) const { return part_at(world_time).duration(); }
  /// Positions and speeds (rad or m, and a second) at a time of the world.
  void sample(double world_time, Eigen::VectorXd& q, Eigen::VectorXd& qd) const;
  /// Those at its end, or at that of a lap.
  void sample_end(Eigen::VectorXd& q, Eigen::VectorXd& qd) const;

 private:
  const robot::Trajectory& part_at(double world_time) const;

  robot::Trajectory lead_, lap_;
  double start_ = 0.0;  // s
};

}  // namespace pedicel::simulation
