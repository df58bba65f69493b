#include "pedicel/app/session/document/file_texts.h"
#include "pedicel/app/session/live/robot_goal.h"
#include "pedicel/app/session/session_core.h"
#include "pedicel/app/session/session_robot.h"
#include "pedicel/core/check.h"
#include "pedicel/io/csv.h"
#include "pedicel/robot/joint_range.h"

/// Programs of the robot: recorded waypoints, trajectory tables.
namespace pedicel::app {

namespace {

/// s, that the joints need from one place to another by hand; the path between rests at both ends,
/// so that it is one and a half times as fast in its middle.
double travel_time(const Snapshot& now, const robot::KinematicModel& model,
                   const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  if (model.dofs() == 0) return 0.0;
  const Eigen::VectorXd speed = manual_speed(model, *now.assets->robot);
  return 1.5 * (to - from).cwiseAbs().cwiseQuotient(speed).maxCoeff();
}

/// The rows from 0 s on, and back to the first.
robot::Trajectory lap_of(const Snapshot& now, const robot::KinematicModel& model,
                         const robot::Trajectory& program) {
  std::vector<double> times;
  for (const double time : program.times()) times.push_back(time - program.times().front());
  std::vector<Eigen::VectorXd> positions = program.positions();
  const double back = travel_time(now, model, positions.back(), positions.front());
  if (back > 0.0) {
    times.push_back(times.back() + back);
    positions.push_back(Eigen::VectorXd(positions.front()));
  }
  return {std::move(times), std::move(positions)};
}

}  // namespace

robot::Trajectory SessionRobot::waypoint_trajectory(const robot::KinematicModel& model) const {
  if (core_.editor.document().waypoints.empty())
    throw UsageError("no waypoints, expected some to be recorded");
  std::vector<double> times;
  std::vector<Eigen::VectorXd> positions;
  for (const RobotWaypoint& one : core_.editor.document().waypoints) {
    if (static_cast<int>(one.joints.size()) != model.dofs())
      throw UsageError("the waypoint at " + io::format_number(one.time) + " s has " +
                       std::to_string(one.joints.size()) + " joints, expected " +
                       std::to_string(model.dofs()));
    // A place that the robot was in may lie a little outside of the limits.
    for (int i = 0; i < model.dofs(); ++i)
      if (const auto fault =
              robot::outside_range(model, i, one.joints[static_cast<std::size_t>(i)], 0.01))
        throw UsageError("the waypoint at " + io::format_number(one.time) + " s: " + *fault);
    times.push_back(one.time);
    positions.push_back(model.clamped(Eigen::Map<const Eigen::VectorXd>(
        one.joints.data(), static_cast<Eigen::Index>(one.joints.size()))));
  }
  return {std::move(times), std::move(positions)};
}

// A program that begins later than now begins with the way there.
Result SessionRobot::play(robot::Trajectory program, bool loops) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  std::vector<double> times = program.times();
  std::vector<Eigen::VectorXd> positions = program.positions();
  if (!loops) {
    if (times.front() > 0.0) {
      times.insert(times.begin(), 0.0);
      positions.insert(positions.begin(), now->robot.q);
    }
    core_.control.play_trajectory({std::move(times), std::move(positions)});
    return {};
  }
  if (times.size() < 2) throw UsageError("one place is no loop, expected two or more");
  const double lead = std::max(times.front(), travel_time(*now, model, now->robot.q, positions[0]));
  robot::Trajectory way = lead > 0.0 ? robot::Trajectory({0.0, lead}, {now->robot.q, positions[0]})
                                     : robot::Trajectory({0.0}, {positions[0]});
  core_.control.play_loop(std::move(way), lap_of(*now, model, program));
  return {};
}

Result SessionRobot::play_waypoints(bool loops) {
  return play(waypoint_trajectory(kinematics_of(*snapshot())), loops);
}

Result SessionRobot::play_trajectory(const std::filesystem::path& file, bool loops) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Diagnostics diagnostics;
  robot::Trajectory trajectory =
      robot::read_trajectory_csv(file, *now->assets->robot, model, now->robot.q, diagnostics);
  if (diagnostics.has_errors()) return {false, sentences(diagnostics.all()), true};
  return play(std::move(trajectory), loops);
}

Result SessionRobot::save_waypoints(const std::filesystem::path& file) const {
  const robot::KinematicModel model = kinematics_of(*snapshot());
  write_with_backup(file, robot::trajectory_csv(waypoint_trajectory(model), model));
  return {};
}

Result SessionRobot::load_waypoints(const std::filesystem::path& file) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Diagnostics diagnostics;
  const robot::Trajectory read =
      robot::read_trajectory_csv(file, *now->assets->robot, model, now->robot.q, diagnostics);
  if (diagnostics.has_errors()) return {false, sentences(diagnostics.all()), true};
  std::vector<double> joints;
  for (const Eigen::VectorXd& row : read.positions())
    joints.insert(joints.end(), row.begin(), row.end());
  return core_.editor.change(
      Command("set waypoints", {{"times", read.times()}, {"joints", std::move(joints)}}));
}

Result SessionRobot::stop() {
  kinematics_of(*snapshot());  // says where there is no robot
  core_.control.stop_robot();
  return {};
}

}  // namespace pedicel::app
