#include "engine/world/scene_writer.h"

#include <cmath>

#include "engine/io/yaml_words.h"
#include "engine/world/scene_fields.h"

namespace pedicel::world {

namespace {

using fields::FlowMap;

std::string line(const std::string& key, const std::string& value) {
  return key + ": " + value + "\n";
}

template <class Items, class Text>
std::string list(const std::string& key, Items&& items, const Text& text,
                 const std::string& indent = "") {
  if (items.empty()) return {};
  std::string lines = indent + key + ":\n";
  for (const auto& item : items) lines += indent + "  - " + text(item) + "\n";
  return lines;
}

std::string head(const Scene& scene) {
  const Scene plain;
  std::string text =
      "format: pedicel-scene\nversion: 1\n" + line("name", io::yaml_word(scene.name));
  text += line("purpose", io::yaml_word(scene.purpose)) + line("see", io::yaml_word(scene.see));
  text += line("duration", io::yaml_number(scene.duration));
  const auto number = [&](const char* key, double value, double otherwise) {
    if (value != otherwise) text += line(key, io::yaml_number(value));
  };
  number("dt", scene.dt, plain.dt);
  number("log_rate", scene.log_rate, plain.log_rate);
  number("seed", scene.seed, plain.seed);
  number("threads", scene.threads, plain.threads);
  if (scene.gravity != plain.gravity) text += line("gravity", fields::vector(scene.gravity));
  const FlowMap rods = fields::settings(scene.rods), coupling = fields::settings(scene.coupling);
  if (!rods.empty()) text += line("rods", rods.text());
  if (!coupling.empty()) text += line("coupling", coupling.text());
  return text;
}

std::string recorded(const RecordedPose& pose) {
  return FlowMap().add("time", pose.time).add("joints", fields::number_list(pose.joints)).text();
}

std::string robot(const SceneRobot& robot, const std::filesystem::path& folder) {
  std::string text = "robot:\n";
  const auto add = [&](const std::string& key, const std::string& value) {
    text += "  " + line(key, value);
  };
  if (robot.name != "robot") add("name", io::yaml_word(robot.name));
  add("file", fields::path_from(folder, robot.file));
  FlowMap packages, joints;
  for (const auto& [name, path] : robot.packages)
    packages.add(name, fields::path_from(folder, path));
  for (const auto& [name, value] : robot.joints) joints.add(io::yaml_word(name), value);
  if (!packages.empty()) add("packages", packages.text());
  if (!robot.base.position.isZero()) add("position", fields::vector(robot.base.position));
  const Quat& q = robot.base.rotation;
  if (q.coeffs() != Quat::Identity().coeffs())
    add("orientation", fields::number_list({q.x(), q.y(), q.z(), q.w()}));
  if (!joints.empty()) add("joints", joints.text());
  if (robot.control != "position") add("control", robot.control);
  if (!robot.tool.empty()) add("tool", io::yaml_word(robot.tool));
  if (!robot.tool_offset.isZero()) add("tool_offset", fields::vector(robot.tool_offset));
  if (!robot.gripper.empty()) add("gripper", io::yaml_word(robot.gripper));
  if (robot.gripper_force != 0.0) add("gripper_force", io::yaml_number(robot.gripper_force));
  if (!robot.trajectory.empty()) add("trajectory", fields::path_from(folder, robot.trajectory));
  text += list("waypoints", robot.waypoints, fields::waypoint, "  ");
  return text + list("recorded", robot.recorded, recorded, "  ");
}

std::string ground(const GroundPlane& ground) {
  return FlowMap()
      .add("height", ground.height)
      .add_unless("friction", ground.friction, GroundPlane{}.friction)
      .add_unless("restitution", ground.restitution, GroundPlane{}.restitution)
      .text();
}

std::string video(const SceneVideo& video) {
  const SceneVideo plain;
  FlowMap map;
  map.add_unless("fps", video.fps, plain.fps);
  if (video.size != plain.size)
    map.add("size", fields::number_list({double(video.size[0]), double(video.size[1])}));
  if (!video.camera.empty()) map.add("camera", io::yaml_word(video.camera));
  return map.empty() ? std::string() : line("video", map.text());
}

std::string things(const Scene& scene, const std::filesystem::path& folder) {
  std::string text;
  if (scene.robot) text += robot(*scene.robot, folder);
  text += list("bodies", scene.bodies, fields::body);
  if (scene.ground) text += line("ground", ground(*scene.ground));
  text += list("loads", scene.loads, fields::load);
  if (scene.wind) text += line("wind", fields::wind(*scene.wind));
  text += list("ties", scene.ties, fields::tie);
  text += list("cuts", scene.cuts, fields::cut);
  text += list("effects", scene.effects, io::piece_text);
  text += list("cameras", scene.cameras, fields::camera);
  for (const InstrumentKind& kind : instrument_kinds())
    text += list(kind.section.c_str(), of_kind(scene, kind), fields::instrument);
  text += fields::look(scene.look);
  text += list("pictures", scene.pictures, fields::picture) + video(scene.video);
  if (scene.sweep)
    text += line("sweep", FlowMap()
                              .add("set", fields::plain(scene.sweep->key))
                              .add("values", fields::number_list(scene.sweep->values))
                              .text());
  if (!scene.vary.empty()) text += "vary:\n";
  for (const VariedNumber& one : scene.vary)
    text += "  " + line(fields::plain(one.key), fields::varied(one));
  return text + list("expect", scene.expectations, fields::expectation);
}

/// Twice a half may have lost the last bit of what was written.
double rounded(double value) {
  return std::round(value * 1e12) / 1e12;
}

bool same(const BodyPart& a, const BodyPart& b) {
  return a.kind == b.kind && a.half_extents.isApprox(b.half_extents, 1e-12) &&
         (a.pose.position - b.pose.position).norm() < 1e-12;
}

}  // namespace

bool is_tray(const BodyDescription& body, Vec3& size, double& wall) {
  if (body.parts.size() != 5 || body.parts[0].kind != BodyPart::Kind::box) return false;
  const Vec3 floor = 2.0 * body.parts[0].half_extents;
  wall = rounded(floor.z());
  size = {rounded(floor.x()), rounded(floor.y()),
          rounded(2.0 * body.parts[1].half_extents.z() + floor.z())};
  if (!(wall > 0.0) || 2.0 * wall >= size.minCoeff()) return false;
  const std::vector<BodyPart> parts = tray_parts(size, wall);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!same(parts[i], body.parts[i])) return false;
  return true;
}

std::string scene_text(const Scene& scene, const std::filesystem::path& folder) {
  return head(scene) +
         list("plants", scene.plants,
              [&](const ScenePlant& plant) { return fields::plant(plant, folder); }) +
         things(scene, folder);
}

std::string scene_text_without_plants(const Scene& scene, const std::filesystem::path& folder) {
  return head(scene) + things(scene, folder);
}

}  // namespace pedicel::world
