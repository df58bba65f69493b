#include "core/check.h"
#include "io/csv.h"
#include "session/session.h"

/// The robot by hand.
namespace pedicel::app {

namespace {

robot::KinematicModel kinematics_of(const Snapshot& now) {
  if (!now.robot.present || !now.assets || !now.assets->robot)
    throw UsageError("the scene has no robot");
  return robot::KinematicModel(*now.assets->robot, now.assets->scene.robot->base);
}

/// What a move by hand starts from: where the robot is sent by hand, else where it is; a program
/// ends with the move.
const Eigen::VectorXd& start_of(const RobotSnapshot& robot) {
  return robot.follows_program ? robot.q : robot.goal;
}

int joint_of(const robot::KinematicModel& model, const std::string& name) {
  const int joint = model.joint_index(name);
  if (joint >= 0) return joint;
  std::string names;
  for (const std::string& one : model.joint_names()) names += (names.empty() ? "" : ", ") + one;
  throw UsageError("no joint \"" + name + "\", expected one of: " + names);
}

}  // namespace

robot::IkResult Session::reach(const Pose& tool_W) const {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  const world::SceneRobot& scene = *now->assets->scene.robot;
  robot::IkTarget target;
  target.link = now->robot.tool_link;
  target.position_W = tool_W.position - tool_W.rotation * scene.tool_offset;
  target.orientation_W = tool_W.rotation;
  robot::IkSettings settings;
  settings.restarts = 6;
  if (!scene.gripper.empty()) settings.held = {joint_of(model, scene.gripper)};
  return robot::inverse_kinematics(model, target, start_of(now->robot), settings);
}

Result Session::move_joints(const Eigen::VectorXd& q) {
  const robot::KinematicModel model = kinematics_of(*snapshot());
  if (q.size() != model.dofs())
    throw UsageError(std::to_string(q.size()) + " values, expected " +
                     std::to_string(model.dofs()) + ", one a joint");
  control_.move_robot(q);
  return {};
}

Result Session::jog(const Vec3& shift_W, const Vec3& turn_W) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Pose tool = model.link_pose(start_of(now->robot), now->robot.tool_link);
  tool.position = tool * now->assets->scene.robot->tool_offset + shift_W;
  const double angle = turn_W.norm();
  if (angle > 0.0)
    tool.rotation = (Eigen::AngleAxisd(angle, turn_W / angle) * tool.rotation).normalized();
  const robot::IkResult reached = reach(tool);
  if (!reached.reached) return {false, reached.sentence};
  return move_joints(reached.q);
}

Result Session::play_waypoints() {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  if (document_.waypoints.empty()) throw UsageError("no waypoints, expected some to be recorded");
  std::vector<double> times;
  std::vector<Eigen::VectorXd> positions;
  if (document_.waypoints.front().time > 0.0) {
    times.push_back(0.0);
    positions.push_back(now->robot.q);
  }
  for (const RobotWaypoint& one : document_.waypoints) {
    if (static_cast<int>(one.joints.size()) != model.dofs())
      throw UsageError("the waypoint at " + io::format_number(one.time) + " s has " +
                       std::to_string(one.joints.size()) + " joints, expected " +
                       std::to_string(model.dofs()));
    times.push_back(one.time);
    positions.push_back(model.clamped(Eigen::Map<const Eigen::VectorXd>(
        one.joints.data(), static_cast<Eigen::Index>(one.joints.size()))));
  }
  control_.play_trajectory({std::move(times), std::move(positions)});
  return {};
}

Result Session::play_trajectory(const std::filesystem::path& file) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Diagnostics diagnostics;
  robot::Trajectory trajectory =
      robot::read_trajectory_csv(file, *now->assets->robot, model, now->robot.q, diagnostics);
  if (diagnostics.has_errors()) return {false, diagnostics.text()};
  control_.play_trajectory(std::move(trajectory));
  return {};
}

Result Session::robot_command(const Command& c) {
  const std::string& verb = c.verb();
  const auto now = snapshot();
  if (verb == "joint" || verb == "gripper") {
    const robot::KinematicModel model = kinematics_of(*now);
    const std::string name = verb == "joint" ? c.word("name") : now->assets->scene.robot->gripper;
    Eigen::VectorXd q = start_of(now->robot);
    q[joint_of(model, name)] = c.number("value");
    return move_joints(q);
  }
  if (verb == "joints") {
    const std::vector<double>& values = c.numbers("values");
    return move_joints(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  }
  if (verb == "jog") return jog(c.point("shift"), c.has("turn") ? c.point("turn") : Vec3::Zero());
  if (verb == "tool") {
    kinematics_of(*now);
    Pose tool = now->robot.tool;
    tool.position = c.point("to");
    if (c.has("turn")) {
      if (c.numbers("turn").size() != 4) throw UsageError("turn, expected x,y,z,w");
      tool.rotation = Quat(c.numbers("turn").data()).normalized();
    }
    const robot::IkResult reached = reach(tool);
    return reached.reached ? move_joints(reached.q) : Result{false, reached.sentence};
  }
  if (verb == "play trajectory") return play_trajectory(c.word("file"));
  return verb == "play waypoints" ? play_waypoints() : Result{};
}

}  // namespace pedicel::app
