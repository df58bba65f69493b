#include "app/ros/joint_follower.h"

#include <algorithm>
#include <cmath>

namespace pedicel::app {

namespace {

constexpr double farthest = 1.0e4;  // rad or m; differences of numbers near the largest are none

/// False for what is no number, too.
bool all_within_reach(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::abs(value) <= farthest; });
}

}  // namespace

JointFollower::JointFollower(simulation::RobotControl& robot)
    : robot_(robot),
      speed_(simulation::manual_speed(robot.robot().model(), robot.description())),
      paths_(static_cast<std::size_t>(robot.robot().model().dofs())),
      columns_(paths_.size(), 0),
      targets_(paths_.size(), 0.0) {
  for (std::size_t j = 0; j < targets_.size(); ++j) targets_[j] = told(static_cast<int>(j));
}

double JointFollower::told(int joint) const {
  const robot::JointCommand& command =
      robot_.robot().motors().commands()[static_cast<std::size_t>(joint)];
  return command.mode == robot::ControlMode::position ? command.position
                                                      : robot_.robot().positions()[joint];
}

std::optional<JointFollower::Plan> JointFollower::plan(const ros::JointTrajectory& message,
                                                       double now, std::string& fault) const {
  const auto refuse = [&](const std::string& why) {
    fault = why;
    return std::nullopt;
  };
  Plan plan;
  if (message.joint_names.empty()) return refuse("no joint_names, expected joints of the robot");
  for (const std::string& name : message.joint_names) {
    const int joint = robot_.robot().model().joint_index(name);
    if (joint < 0) return refuse("no joint " + in_quotes(name) + " that moves by itself");
    if (std::ranges::find(plan.joints, joint) != plan.joints.end())
      return refuse("joint " + in_quotes(name) + " appears twice, expected each once");
    plan.joints.push_back(joint);
  }
  if (message.points.empty()) return refuse("no points, expected one at least");
  if (message.points.size() > most_points)
    return refuse("more than " + std::to_string(most_points) + " points");
  const auto size = static_cast<long>(plan.joints.size());
  std::vector<double> times = {0.0};
  std::vector<Eigen::VectorXd> rows(1, Eigen::VectorXd(size));
  for (long c = 0; c < size; ++c) {
    const int joint = plan.joints[static_cast<std::size_t>(c)];
    rows[0][c] = leads_ ? target(joint) : told(joint);
  }
  for (const ros::JointTrajectoryPoint& point : message.points) {
    if (static_cast<long>(point.positions.size()) != size || !all_within_reach(point.positions))
      return refuse("a point without a position of each joint within 10,000 rad or m");
    double time = ros::seconds_of(point.time_from_start);
    const Eigen::VectorXd row = Eigen::Map<const Eigen::VectorXd>(point.positions.data(), size);
    if (time <= 0.0 && times.size() == 1) {
      // As a controller would: at once, that is as fast as it goes.
      for (long c = 0; c < size; ++c)
        time = std::max(
            time, std::abs(row[c] - rows[0][c]) / speed_[plan.joints[static_cast<std::size_t>(c)]]);
      if (message.points.size() > 1 || time == 0.0) {
        if (time > 1.0e-3 && message.points.size() > 1 &&
            ros::seconds_of(message.points[1].time_from_start) <= time)
          return refuse("the first point is farther away than the joints get before the second");
        if (time == 0.0 && message.points.size() > 1) continue;
        time = std::max(time, 1.0e-3);
      }
    }
    if (!(time > times.back())) return refuse("time_from_start does not increase");
    times.push_back(time);
    rows.push_back(row);
  }
  if (times.size() == 1) {
    times.push_back(1.0e-3);
    rows.push_back(rows.front());
  }
  const ros::Time& stamp = message.header.stamp;
  const bool stamped = stamp.sec != 0 || stamp.nanosec != 0;
  plan.start = stamped ? ros::seconds_of(stamp) : now;
  if (plan.start + times.back() < now)
    return refuse("it ended before now: the stamp is no simulated time, or is an old one");
  plan.path = robot::Trajectory(std::move(times), std::move(rows));
  return plan;
}

void JointFollower::take_over() {
  if (leads_) return;
  for (std::size_t j = 0; j < targets_.size(); ++j) targets_[j] = told(static_cast<int>(j));
  robot_.lead_by_motors();
  leads_ = true;
}

int JointFollower::follow(Plan plan) {
  take_over();
  const auto path = std::make_shared<const Path>(Path{++last_, std::move(plan.path), plan.start});
  for (std::size_t c = 0; c < plan.joints.size(); ++c) {
    const auto joint = static_cast<std::size_t>(plan.joints[c]);
    paths_[joint] = path;
    columns_[joint] = static_cast<int>(c);
  }
  return last_;
}

void JointFollower::hold(const std::vector<int>& joints) {
  take_over();
  for (const int joint : joints) paths_[static_cast<std::size_t>(joint)] = nullptr;
}

bool JointFollower::follows(int number, const std::vector<int>& joints) const {
  return std::ranges::all_of(joints, [&](int joint) {
    const auto& path = paths_[static_cast<std::size_t>(joint)];
    return path && path->number == number;
  });
}

void JointFollower::act(world::SimWorld& world, world::WorldReport&) {
  if (!leads_) return;
  for (std::size_t j = 0; j < paths_.size(); ++j) {
    double speed = 0.0;
    if (const auto& path = paths_[j]) {
      const auto size = path->path.positions().front().size();
      Eigen::VectorXd q(size), qd(size);
      // A target is where the joint shall be at the end of this step.
      path->path.sample(world.time() + world.dt() - path->start, q, qd);
      targets_[j] = q[columns_[j]];
      speed = qd[columns_[j]];
    }
    robot_.robot().motors().set_position_target(static_cast<int>(j), targets_[j], speed);
  }
}

}  // namespace pedicel::app
