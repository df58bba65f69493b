#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/ros_messages/control_messages.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::app {

/// Leads joints of a robot along paths that come from outside, each on its own: an arm and its
/// gripper may follow two at once. Until the first one comes the scene's program goes on;
/// afterwards joints without a path stay where they were told to be.
class JointFollower : public world::Participant {
 public:
  static constexpr std::size_t most_points = 100000;

  /// The robot must outlive it. To be added to the world.
  explicit JointFollower(simulation::RobotControl& robot);

  /// A path for some joints.
  struct Plan {
    std::vector<int> joints;  ///< degrees of freedom
    robot::Trajectory path;   ///< a column each, rad or m
    double start = 0.0;       ///< s of the world
  };
  /// From where the joints are told to be now, through the points of a message. A point at time 0
  /// is reached as fast as the joints go by hand (manual_speed()). Nothing, and why in `fault`,
  /// where the message makes no sense for this robot.
  std::optional<Plan> plan(const ros::JointTrajectory& message, double now,
                           std::string& fault) const;
  /// Begins it; returns its number.
  int follow(Plan plan);
  /// Those joints stay where they are told to be now.
  void hold(const std::vector<int>& joints);
  /// Whether all joints of a path still follow it.
  bool follows(int number, const std::vector<int>& joints) const;
  /// rad or m, where a joint is told to be.
  double target(int joint) const { return targets_[static_cast<std::size_t>(joint)]; }

  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

 private:
  struct Path {
    int number = 0;
    robot::Trajectory path;
    double start = 0.0;
  };
  void take_over();
  double told(int joint) const;

  simulation::RobotControl& robot_;
  Eigen::VectorXd speed_;
  bool leads_ = false;
  int last_ = 0;
  std::vector<std::shared_ptr<const Path>> paths_;  // by joint; null: it stays
  std::vector<int> columns_;                        // of the joint in its path
  std::vector<double> targets_;
};

}  // namespace pedicel::app
