#include "engine/robot/cartesian_path.h"

namespace pedicel::robot {

namespace {

std::map<std::string, double> read_joints(const io::YamlNode& node) {
  std::map<std::string, double> joints;
  if (!node.is_map()) {
    node.error("joints: expected a map such as {finger_joint: 0.02}");
    return joints;
  }
  for (const auto& item : node.raw()) {
    const io::YamlNode value(item.second, node.file(), node.diagnostics());
    const std::string name = item.first.as<std::string>();
    joints[name] = value.number(name);
  }
  return joints;
}

}  // namespace

std::vector<Waypoint> read_waypoints(const io::YamlNode& list, const std::string& default_tool) {
  std::vector<Waypoint> waypoints;
  for (const io::YamlNode& node : list.list("waypoints")) {
    io::YamlMap map(node, "a waypoint");
    Waypoint waypoint;
    waypoint.where = map.position();
    waypoint.time = map.number("time", io::not_negative);
    waypoint.tool = default_tool.empty() ? map.text("tool") : map.text("tool", default_tool);
    waypoint.position_W = map.vector("position");
    if (const auto orientation = map.optional("orientation"))
      waypoint.orientation_W = orientation->quaternion("orientation");
    if (const auto approach = map.optional("approach")) {
      waypoint.approach_W = approach->vector("approach");
      if (waypoint.orientation_W)
        approach->error("approach beside orientation, expected one of them");
      else if (waypoint.approach_W->norm() < 1e-6)
        approach->error("approach of length 0, expected a direction such as [0, 0, -1]");
      else
        waypoint.approach_W->normalize();
    }
    if (const auto joints = map.optional("joints")) waypoint.joints = read_joints(*joints);
    map.finish();
    waypoints.push_back(std::move(waypoint));
  }
  return waypoints;
}

}  // namespace pedicel::robot
