#pragma once

#include <memory>

#include "app/ros/action_server.h"
#include "app/ros/joint_follower.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// The actions of a robot: /arm_controller/follow_joint_trajectory, and, where the scene names a
/// gripper, /gripper_controller/gripper_cmd.
class ArmActions {
 public:
  using Refuse = std::function<void(const std::string& what, const std::string& why)>;

  /// Node and queue must outlive it.
  ArmActions(DdsNode& node, CommandQueue& queue, bool gripper, Refuse refuse);
  /// The simulation that is led from now on; what was followed before is given up. All must stay
  /// until the next call.
  void lead(const simulation::Simulation& simulation, simulation::RobotControl& robot,
            JointFollower& follower);
  void after_step();

 private:
  using Follow = ros::FollowJointTrajectory;
  using Grip = ros::GripperCommand;
  bool begin_path(const Follow::Goal& goal, std::string& fault);
  ActionServer<Follow>::Answer look_at_path() const;
  bool begin_grip(const Grip::Goal& goal, std::string& fault);
  ActionServer<Grip>::Answer look_at_grip();
  double now() const { return simulation_ ? simulation_->world().time() : 0.0; }

  const simulation::Simulation* simulation_ = nullptr;
  simulation::RobotControl* robot_ = nullptr;
  JointFollower* follower_ = nullptr;
  struct Path {
    int number = 0;
    double begin = 0.0, end = 0.0, patience = 0.0;  // s; patience: for the goal's tolerance
    std::vector<int> joints;
    std::vector<double> goal, path_tolerance, goal_tolerance;  // rad or m; 0: none
  } path_;
  struct GripPath {
    int number = 0;
    double end = 0.0, goal = 0.0;
    double still_since = 0.0;  // s
  } grip_;
  std::unique_ptr<ActionServer<Follow>> paths_;
  std::unique_ptr<ActionServer<Grip>> grips_;  // null: no gripper
};

}  // namespace pedicel::app
