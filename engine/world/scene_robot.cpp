#include "engine/io/thing_bounds.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

using io::KeyType;
using io::Told;

const io::KeyList& robot_list() {
  const Told none{"none"};
  static const io::KeyList keys{
      "robot",
      "robot",
      {{.name = "name",
        .type = KeyType::text,
        .otherwise = SceneRobot{}.name,
        .sentence = "its links are `NAME/LINK`"},
       {.name = "file", .type = KeyType::path, .sentence = "URDF"},
       {.name = "packages",
        .type = KeyType::map,
        .otherwise = none,
        .form = "names with paths",
        .sentence = "where `package://NAME` lies"},
       {.name = "joints",
        .type = KeyType::map,
        .unit = "rad or m",
        .otherwise = Told{"0"},
        .form = "joint names with numbers, within the joint's limits",
        .sentence = "start values"},
       {.name = "control",
        .type = KeyType::word,
        .otherwise = SceneRobot{}.control,
        .words = {"position", "velocity", "torque"},
        .sentence = "how the joints are driven"},
       {.name = "tool",
        .type = KeyType::text,
        .otherwise = Told{"the robot's own"},
        .form = "name of a link",
        .sentence = "link that waypoints move"},
       {.name = "tool_offset",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = SceneRobot{}.tool_offset,
        .bounds = io::place_bounds,
        .sentence = "tool point in that link"},
       {.name = "gripper",
        .type = KeyType::text,
        .otherwise = none,
        .form = "name of a joint",
        .sentence = "joint that grips"},
       {.name = "gripper_force",
        .unit = "N or N m",
        .otherwise = SceneRobot{}.gripper_force,
        .bounds = {0.0, largest_gripper_force},
        .sentence = "it presses with at most this; 0: with its effort"},
       {.name = "trajectory",
        .type = KeyType::path,
        .otherwise = none,
        .sentence = "table of joint positions: `time_s`, then a column a joint"},
       {.name = "waypoints",
        .type = KeyType::list,
        .otherwise = none,
        .sentence = "places of the tool, in place of `trajectory`"},
       {.name = "recorded",
        .type = KeyType::list,
        .otherwise = none,
        .sentence = "poses recorded in the window, played on demand only"}},
      "",
      {&pose_keys()}};
  return keys;
}

const io::KeyList& waypoint_list() {
  const Told before{"as before"};
  static const io::KeyList keys{"waypoint",
                                "a waypoint",
                                {{.name = "time",
                                  .unit = "s",
                                  .bounds = io::not_negative,
                                  .form = "rising",
                                  .sentence = "when the tool is there"},
                                 {.name = "position",
                                  .type = KeyType::vector,
                                  .unit = "m",
                                  .otherwise = Told{"needed without `at`"},
                                  .bounds = io::place_bounds,
                                  .sentence = "where, in the world"},
                                 {.name = "at",
                                  .type = KeyType::map,
                                  .otherwise = Told{"none"},
                                  .form = "a thing",
                                  .sentence = "where, at a thing"},
                                 {.name = "offset",
                                  .type = KeyType::vector,
                                  .unit = "m",
                                  .otherwise = Vec3(0, 0, 0),
                                  .bounds = io::place_bounds,
                                  .sentence = "from that thing"},
                                 {.name = "orientation",
                                  .type = KeyType::rotation,
                                  .otherwise = before,
                                  .sentence = "turn of the tool"},
                                 {.name = "facing",
                                  .type = KeyType::map,
                                  .otherwise = before,
                                  .sentence = "turn of the tool by two directions"},
                                 {.name = "gripper",
                                  .unit = "m or rad",
                                  .otherwise = before,
                                  .form = "within the joint's limits",
                                  .sentence = "position of the gripper's joint"}}};
  return keys;
}

const io::KeyList& facing_list() {
  static const io::KeyList keys{"facing",
                                "facing",
                                {{.name = "approach",
                                  .type = KeyType::vector,
                                  .unit = "1",
                                  .form = "a direction",
                                  .sentence = "where the tool's Z axis points"},
                                 {.name = "across",
                                  .type = KeyType::vector,
                                  .unit = "1",
                                  .otherwise = Vec3(0, 1, 0),
                                  .form = "another direction",
                                  .sentence = "where its Y axis points, as near as can be"}},
                                "facing"};
  return keys;
}

const io::KeyList& recorded_list() {
  static const io::KeyList keys{"recorded",
                                "a recorded place",
                                {{.name = "time",
                                  .unit = "s",
                                  .bounds = io::not_negative,
                                  .form = "rising",
                                  .sentence = "when"},
                                 {.name = "joints",
                                  .type = KeyType::numbers,
                                  .unit = "rad or m",
                                  .form = "one a joint",
                                  .sentence = "where"}}};
  return keys;
}

/// The way the tool points (its Z axis) and the way its Y axis, along which the fingers close, is
/// to look as nearly as possible.
Quat facing(const io::YamlNode& node) {
  io::DescribedMap map(node, facing_list());
  const Vec3 approach = map.vector("approach"), across = map.vector("across");
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
  io::DescribedMap map(node, waypoint_list());
  waypoint.where = node.position();
  waypoint.time = map.number("time");
  if (const auto at = map.optional("at")) waypoint.at = read_anchor(*at, "at");
  const char* key = waypoint.at.kind == Anchor::Kind::none ? "position" : "offset";
  const auto place = waypoint.at.kind == Anchor::Kind::none ? map.required(key) : map.optional(key);
  if (place) waypoint.position = read_place(map, key);
  const auto orientation = map.optional("orientation"), faces = map.optional("facing");
  if (orientation && faces) node.error("a waypoint: expected orientation or facing, not both");
  if (orientation) waypoint.orientation = orientation->quaternion("orientation");
  if (faces) waypoint.orientation = facing(*faces);
  waypoint.gripper = map.optional_number("gripper");
  map.finish();
  return waypoint;
}

void read_waypoints(io::DescribedMap& map, SceneRobot& robot) {
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
  io::DescribedMap map(node, recorded_list());
  pose.time = map.number("time");
  if (const auto joints = map.required("joints")) pose.joints = joints->numbers("joints");
  map.finish();
  return pose;
}

void read_recorded(io::DescribedMap& map, SceneRobot& robot) {
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

void read_packages(io::DescribedMap& map, const std::filesystem::path& folder, SceneRobot& robot) {
  const auto packages = map.optional("packages");
  if (!packages) return;
  for (const Setting& package : read_settings(*packages, "packages"))
    robot.packages.emplace_back(package.key, (folder / package.text).lexically_normal());
}

void read_joints(io::DescribedMap& map, SceneRobot& robot) {
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

std::vector<const io::KeyList*> robot_keys() {
  return {&robot_list(), &waypoint_list(), &facing_list(), &recorded_list()};
}

SceneRobot read_robot(const io::YamlNode& node, const std::filesystem::path& folder) {
  SceneRobot robot;
  io::DescribedMap map(node, robot_list());
  robot.where = node.position();
  robot.name = map.text("name");
  if (const auto file = map.required("file")) robot.file = read_path(*file, "file", folder);
  read_packages(map, folder, robot);
  robot.base = read_pose(map);
  read_joints(map, robot);
  robot.control = map.choice("control");
  robot.tool = map.text("tool");
  robot.tool_offset = read_place(map, "tool_offset");
  robot.gripper = map.text("gripper");
  robot.gripper_force = map.number("gripper_force");
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
