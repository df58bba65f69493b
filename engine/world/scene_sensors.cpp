#include <algorithm>
#include <cmath>

#include "pedicel/world/scene_sections.h"
#include "pedicel/world/settings.h"

namespace pedicel::world::sections {

namespace {

constexpr io::Bounds sensor_rates{1e-3, 1e4};

template <class Noise>
void read_described(io::YamlMap& map, const char* key, Noise& noise) {
  if (const auto node = map.optional(key))
    apply_settings(read_settings(*node, key), key, noise.parameters(), {}, node->diagnostics());
}

std::vector<Sensor> read_sensor_words(const io::YamlNode& node) {
  std::vector<std::string> words;
  for (int s = 0; s < sensor_count; ++s) words.emplace_back(name_of(static_cast<Sensor>(s)));
  std::vector<Sensor> sensors;
  for (const io::YamlNode& one : node.list("sensors")) {
    const std::string word = one.choice("sensors", words);
    const auto sensor = static_cast<Sensor>(std::ranges::find(words, word) - words.begin());
    if (std::ranges::count(sensors, sensor) > 0)
      one.error("sensors: \"" + word + "\" comes twice, expected once");
    else
      sensors.push_back(sensor);
  }
  return sensors;
}

/// As measured cameras have it: a place and a turn of the frame with x right, y down, z forward.
void read_optical_pose(io::YamlMap& map, SceneCamera& camera) {
  if (map.has("eye") || map.has("target"))
    map.error("a camera: expected eye and target, or position and orientation, not both");
  const Pose pose = read_pose(map);
  camera.eye = pose.position;
  camera.target = pose * Vec3::UnitZ();
  camera.up = pose.rotation * -Vec3::UnitY();
}

/// `focal` in pixels in place of `fov`. Pictures have square pixels and the axis in their middle.
void read_focal(io::YamlMap& map, SceneCamera& camera) {
  const auto node = map.optional("focal");
  if (!node) return;
  if (map.has("fov")) node->error("focal: expected fov or focal, not both");
  std::vector<double> focal;
  const int before = node->diagnostics().error_count();
  if (node->is_list())
    focal = node->numbers("focal", io::positive);
  else
    focal = {node->number("focal", io::positive)};
  if (node->diagnostics().error_count() > before) return;
  if (focal.empty() || focal.size() > 2 || (focal.size() == 2 && focal[0] != focal[1]))
    return node->error("focal: expected one length in pixels, or two equal ones");
  camera.field_of_view = 2.0 * std::atan(0.5 * camera.size[1] / focal[0]);
  if (!(camera.field_of_view >= 0.01 && camera.field_of_view <= 3.0))
    node->error("focal: gives a field of view beyond 0.01 to 3 rad");
}

void read_size(io::YamlMap& map, std::array<int, 2>& size) {
  const auto node = map.optional("size");
  if (!node) return;
  const auto parts = node->list("size");
  if (parts.size() != 2) return node->error("size: expected [width, height] in pixels");
  for (std::size_t i = 0; i < 2; ++i) size[i] = parts[i].integer("size", 16, 8192);
}

}  // namespace

SceneCamera read_camera(const io::YamlNode& node) {
  SceneCamera camera;
  const int before = node.diagnostics().error_count();
  io::YamlMap map(node, "a camera");
  camera.name = map.text("name");
  read_size(map, camera.size);
  if (map.has("orientation")) {
    read_optical_pose(map, camera);
  } else {
    camera.eye = read_place(map, "eye");
    camera.target = read_place(map, "target", Vec3::Zero());
  }
  camera.field_of_view = map.number("fov", {0.01, 3.0}, camera.field_of_view);
  read_focal(map, camera);
  if (const auto follow = map.optional("follow")) camera.follow = read_anchor(*follow, "follow");
  if (const auto words = map.optional("sensors")) camera.sensors = read_sensor_words(*words);
  camera.rate = map.number("rate", sensor_rates, camera.rate);
  read_described(map, "noise", camera.noise);
  const bool is_read = node.diagnostics().error_count() == before;
  if (is_read && !((camera.eye - camera.target).norm() > 1e-6))
    node.error("a camera: expected eye and target to be apart");
  map.finish();
  return camera;
}

SceneWrench read_wrench(const io::YamlNode& node) {
  SceneWrench wrench;
  io::YamlMap map(node, "a wrench");
  wrench.where = node.position();
  wrench.name = map.text("name");
  wrench.link = map.text("link");
  wrench.touch = map.boolean("touch", false);
  wrench.tared = map.boolean("tared", false);
  wrench.rate = map.number("rate", sensor_rates, wrench.rate);
  read_described(map, "noise", wrench.noise);
  map.finish();
  return wrench;
}

SceneLook read_look(const io::YamlNode& node) {
  SceneLook look;
  apply_settings(read_settings(node, "look"), "look", look.parameters(), {}, node.diagnostics());
  return look;
}

}  // namespace pedicel::world::sections
