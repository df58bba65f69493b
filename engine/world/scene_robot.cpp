#include "pedicel/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

/// The way the tool points (its Z axis) and the way its Y axis, along which the fingers close, is
/// to look as nearly as possible.
Quat facing(const io::YamlNode& node) {
  io::YamlMap map(node, "facing");
  const Vec3 approach = map.vector("approach"), across = map.vector("across", Vec3::UnitY());
  map.finish();
  const Vec3 x = across.cross(approach);
  if (!(x.norm() > 1e-6 * across.norm() * approach.norm())) {
    node.error("facing: expected approach and across that are not parallel and not zero");
    return Quat::Identity();
  }
  Mat3 axes;
  axes.col(2) = approach.normalized();
  axes.col(0) = x.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return Quat(axes);
}

SceneWaypoint read_waypoint(const io::YamlNode& node) {
  SceneWaypoint waypoint;
  io::YamlMap map(node, "a waypoint");
  waypoint.where = node.position();
  waypoint.time = map.number("time", io::not_negative);
  if (const auto at = map.optional("at")) waypoint.at = read_anchor(*at, "at");
  const char* key = waypoint.at.kind == Anchor::Kind::none ? "position" : "offset";
  const auto place = waypoint.at.kind == Anchor::Kind::none ? map.required(key) : map.optional(key);
  if (place) waypoint.position = read_place(map, key);
  const auto orientation = map.optional("orientation"), faces = map.optional("facing");
  if (orientation && faces) node.error("a waypoint: expected orientation or facing, not both");
  if (orientation) waypoint.orientation = orientation->quaternion("orientation");
  if (faces) waypoint.orientation = facing(*faces);
  if (const auto gripper = map.optional("gripper"))
    waypoint.gripper = gripper->number("gripper", io::any_number);
  map.finish();
  return waypoint;
}

void read_waypoints(io::YamlMap& map, SceneRobot& robot) {
  for (const io::YamlNode& node : map.list("waypoints")) {
    SceneWaypoint waypoint = read_waypoint(node);
    if (!robot.waypoints.empty() && waypoint.time <= robot.waypoints.back().time)
      node.error("time: expected later than the waypoint before");
    if (robot.waypoints.empty() && !waypoint.orientation)
      node.error("the first waypoint: expected an orientation or facing");
    robot.waypoints.push_back(std::move(waypoint));
  }
}

RecordedPose read_recorded_pose(const io::YamlNode& node) {
  RecordedPose pose;
  io::YamlMap map(node, "a recorded place");
  pose.time = map.number("time", io::not_negative);
  if (const auto joints = map.required("joints")) pose.joints = joints->numbers("joints");
  map.finish();
  return pose;
}

void read_recorded(io::YamlMap& map, SceneRobot& robot) {
  for (const io::YamlNode& node : map.list("recorded")) {
    RecordedPose pose = read_recorded_pose(node);
    if (!robot.recorded.empty() && pose.time <= robot.recorded.back().time)
      node.error("time: expected later than the recorded place before");
    if (pose.joints.empty()) node.error("joints: expected one number a joint");
    if (!robot.recorded.empty() && pose.joints.size() != robot.recorded.front().joints.size())
      node.error("joints: expected as many as at the first recorded place");
    robot.recorded.push_back(std::move(pose));
  }
}

void read_packages(io::YamlMap& map, const std::filesystem::path& folder, SceneRobot& robot) {
  const auto packages = map.optional("packages");
  if (!packages) return;
  for (const Setting& package : read_settings(*packages, "packages"))
    robot.packages.emplace_back(package.key, (folder / package.text).lexically_normal());
}

void read_joints(io::YamlMap& map, SceneRobot& robot) {
  const auto joints = map.optional("joints");
  if (!joints) return;
  if (!joints->is_map()) return joints->error("joints: expected joint names with start values");
  for (const auto& item : joints->raw()) {
    const io::YamlNode value(item.second, joints->file(), joints->diagnostics());
    robot.joints[item.first.Scalar()] = value.number(item.first.Scalar());
    robot.joints_where[item.first.Scalar()] = value.position();
  }
}

}  // namespace

SceneRobot read_robot(const io::YamlNode& node, const std::filesystem::path& folder) {
  SceneRobot robot;
  io::YamlMap map(node, "robot");
  robot.where = node.position();
  robot.name = map.text("name", "robot");
  if (const auto file = map.required("file")) robot.file = read_path(*file, "file", folder);
  read_packages(map, folder, robot);
  robot.base = read_pose(map);
  read_joints(map, robot);
  robot.control = map.choice("control", {"position", "velocity", "torque"}, "position");
  robot.tool = map.text("tool", "");
  robot.tool_offset = read_place(map, "tool_offset", Vec3::Zero());
  robot.gripper = map.text("gripper", "");
  robot.gripper_force = map.number("gripper_force", {0.0, largest_gripper_force}, 0.0);
  if (robot.gripper_force > 0.0 && robot.gripper.empty())
    map.error("gripper_force: expected only beside the joint that grips, as \"gripper\"");
  if (const auto trajectory = map.optional("trajectory"))
    robot.trajectory = read_path(*trajectory, "trajectory", folder);
  read_waypoints(map, robot);
  read_recorded(map, robot);
  if (!robot.trajectory.empty() && !robot.waypoints.empty())
    map.error("robot: expected trajectory or waypoints, not both");
  map.finish();
  return robot;
}

}  // namespace pedicel::world::sections
