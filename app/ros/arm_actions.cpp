#include "app/ros/arm_actions.h"

#include <cmath>

#include "engine/ros_messages/cdr.h"

namespace pedicel::app {

namespace {

constexpr double reached = 1.0e-3;        // rad or m, of a gripper
constexpr double still_speed = 1.0e-3;    // rad/s or m/s
constexpr double time_to_be_still = 0.2;  // s

/// Of each joint its tolerance, 0 where none is given.
std::vector<double> tolerances_of(const std::vector<ros::JointTolerance>& given,
                                  const std::vector<std::string>& joints) {
  std::vector<double> all;
  for (const std::string& joint : joints) {
    const auto found = std::ranges::find(given, joint, &ros::JointTolerance::joint);
    all.push_back(found == given.end() ? 0.0 : found->position);
  }
  return all;
}

}  // namespace

ArmActions::ArmActions(DdsNode& node, CommandQueue& queue, bool gripper, Refuse refuse) {
  paths_ = std::make_unique<ActionServer<Follow>>(
      node, queue, "/arm_controller/follow_joint_trajectory",
      ActionServer<Follow>::Handlers{
          [this](const Follow::Goal& goal, std::string& fault) { return begin_path(goal, fault); },
          [this] { return look_at_path(); }, [this] { follower_->hold(path_.joints); }, refuse,
          [this] { return now(); }});
  if (!gripper) return;
  grips_ = std::make_unique<ActionServer<Grip>>(
      node, queue, "/gripper_controller/gripper_cmd",
      ActionServer<Grip>::Handlers{
          [this](const Grip::Goal& goal, std::string& fault) { return begin_grip(goal, fault); },
          [this] { return look_at_grip(); }, [this] { follower_->hold({robot_->gripper()}); },
          refuse, [this] { return now(); }});
}

void ArmActions::lead(const simulation::Simulation& simulation, simulation::RobotControl& robot,
                      JointFollower& follower) {
  paths_->abort();
  if (grips_) grips_->abort();
  simulation_ = &simulation;
  robot_ = &robot;
  follower_ = &follower;
}

void ArmActions::after_step() {
  paths_->after_step();
  if (grips_) grips_->after_step();
}

bool ArmActions::begin_path(const Follow::Goal& goal, std::string& fault) {
  if (!goal.multi_dof_trajectory.points.empty()) {
    fault = "multi_dof_trajectory is not empty, expected joints of one degree of freedom";
    return false;
  }
  auto plan = follower_->plan(goal.trajectory, now(), fault);
  if (!plan) return false;
  path_.joints = plan->joints;
  path_.begin = plan->start;
  path_.end = plan->start + plan->path.duration();
  path_.patience = std::max(0.0, ros::seconds_of(goal.goal_time_tolerance));
  path_.goal.assign(plan->path.positions().back().begin(), plan->path.positions().back().end());
  path_.path_tolerance = tolerances_of(goal.path_tolerance, goal.trajectory.joint_names);
  path_.goal_tolerance = tolerances_of(goal.goal_tolerance, goal.trajectory.joint_names);
  path_.number = follower_->follow(std::move(*plan));
  return true;
}

ActionServer<ros::FollowJointTrajectory>::Answer ArmActions::look_at_path() const {
  ActionServer<Follow>::Answer answer;
  const robot::Robot& robot = robot_->robot();
  Follow::Feedback& told = answer.feedback;
  told.header.stamp = ros::stamp_of(now());
  bool on_path = true, at_goal = true;
  for (std::size_t c = 0; c < path_.joints.size(); ++c) {
    const int joint = path_.joints[c];
    const double wanted = follower_->target(joint), is = robot.positions()[joint];
    told.joint_names.push_back(robot.model().joint_names()[static_cast<std::size_t>(joint)]);
    told.desired.positions.push_back(wanted);
    told.actual.positions.push_back(is);
    told.actual.velocities.push_back(robot.velocities()[joint]);
    told.error.positions.push_back(wanted - is);
    if (path_.path_tolerance[c] > 0.0)
      on_path = on_path && std::abs(wanted - is) <= path_.path_tolerance[c];
    if (path_.goal_tolerance[c] > 0.0)
      at_goal = at_goal && std::abs(path_.goal[c] - is) <= path_.goal_tolerance[c];
  }
  for (ros::JointTrajectoryPoint* point : {&told.desired, &told.actual, &told.error})
    point->time_from_start = ros::stamp_of<ros::Duration>(std::max(0.0, now() - path_.begin));
  if (!follower_->follows(path_.number, path_.joints)) {
    answer.status = ros::GoalStatus::aborted;
    answer.result = {Follow::Result::invalid_goal, "another trajectory took its joints"};
  } else if (!on_path) {
    follower_->hold(path_.joints);
    answer.status = ros::GoalStatus::aborted;
    answer.result = {Follow::Result::path_tolerance_violated, "a joint left its path"};
  } else if (now() >= path_.end && at_goal) {
    answer.status = ros::GoalStatus::succeeded;
  } else if (now() > path_.end + path_.patience) {
    answer.status = ros::GoalStatus::aborted;
    answer.result = {Follow::Result::goal_tolerance_violated, "a joint did not reach its goal"};
  }
  return answer;
}

bool ArmActions::begin_grip(const Grip::Goal& goal, std::string& fault) {
  const robot::KinematicModel& model = robot_->robot().model();
  ros::JointTrajectory path;
  path.joint_names = {model.joint_names()[static_cast<std::size_t>(robot_->gripper())]};
  path.points = {{{goal.command.position}, {}, {}, {}, {}}};
  if (!std::isfinite(goal.command.max_effort) || goal.command.max_effort < 0.0) {
    fault = "max_effort is no number from 0 on";
    return false;
  }
  auto plan = follower_->plan(path, now(), fault);
  if (!plan) return false;
  if (goal.command.max_effort > 0.0)
    robot_->robot().motors().set_effort_limit(robot_->gripper(), goal.command.max_effort);
  grip_.goal = goal.command.position;
  grip_.end = plan->start + plan->path.duration();
  grip_.still_since = now();
  grip_.number = follower_->follow(std::move(*plan));
  return true;
}

ActionServer<ros::GripperCommand>::Answer ArmActions::look_at_grip() {
  ActionServer<Grip>::Answer answer;
  const int joint = robot_->gripper();
  const robot::Robot& robot = robot_->robot();
  const double is = robot.positions()[joint];
  if (std::abs(robot.velocities()[joint]) > still_speed || now() < grip_.end)
    grip_.still_since = now();
  const bool still = now() - grip_.still_since >= time_to_be_still;
  const bool there = std::abs(is - grip_.goal) <= reached;
  answer.feedback = {is, robot.motor_torques()[joint], still && !there, there};
  answer.result = {is, robot.motor_torques()[joint], still && !there, there};
  if (!follower_->follows(grip_.number, {joint}))
    answer.status = ros::GoalStatus::aborted;
  else if (there || still)
    // Fingers that something stops have gripped it.
    answer.status = ros::GoalStatus::succeeded;
  return answer;
}

}  // namespace pedicel::app
