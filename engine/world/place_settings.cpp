#include "engine/world/place_settings.h"

#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/world/scene_sections.h"
#include "engine/world/settings.h"

namespace pedicel::world {

namespace {

constexpr double farthest = 1.0e4;  // m

double within(const std::string& text, double low, double high, const std::string& asked) {
  const std::optional<double> value = to_number(text);
  if (value && *value >= low && *value <= high) return *value;
  throw UsageError(asked + " = \"" + text + "\": must be a number between " +
                   io::format_number(low) + " and " + io::format_number(high));
}

/// The axis of "WORD.x"; -1 where the key is something else.
int axis_of(const std::string& key, const std::string& word) {
  constexpr std::array<const char*, 3> axes = {".x", ".y", ".z"};
  for (int axis = 0; axis < 3; ++axis)
    if (key == word + axes[static_cast<std::size_t>(axis)]) return axis;
  return -1;
}

bool set_pose(Pose& pose, const std::string& rest, const std::string& text,
              const std::string& asked) {
  if (const int axis = axis_of(rest, "position"); axis >= 0) {
    pose.position[axis] = within(text, -farthest, farthest, asked);
    return true;
  }
  if (rest != "yaw") return false;
  const double yaw = within(text, -2.0 * std::numbers::pi, 2.0 * std::numbers::pi, asked);
  pose.rotation = Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  return true;
}

/// "SECTION.KEY" of what describes its numbers itself. Whether `rest` begins with the section.
template <class Described>
bool set_described(Described& described, const std::string& section, const std::string& rest,
                   const std::string& text, const std::string& asked) {
  if (!rest.starts_with(section + ".")) return false;
  const std::string name = rest.substr(section.size() + 1);
  const std::vector<Parameter> parameters = described.parameters();
  const Parameter* parameter = find_parameter(parameters, name);
  if (!parameter)
    throw UsageError(asked + ": there is no " + section + "." + name +
                     ", expected one of: " + parameter_names(parameters));
  const std::optional<double> value = to_number(text);
  if (!value) throw UsageError(asked + " = \"" + text + "\": must be a number");
  if (const auto refused = set_parameter(*parameter, *value))
    throw UsageError(asked + ": " + section + "." + *refused);
  return true;
}

bool set_camera(SceneCamera& camera, const std::string& rest, const std::string& text,
                const std::string& asked) {
  for (const auto& [word, place] : {std::pair<const char*, Vec3*>{"eye", &camera.eye},
                                    std::pair<const char*, Vec3*>{"target", &camera.target}})
    if (const int axis = axis_of(rest, word); axis >= 0) {
      (*place)[axis] = within(text, -farthest, farthest, asked);
      if (!((camera.eye - camera.target).norm() > 1e-6))
        throw UsageError(asked + ": expected eye and target to be apart");
      return true;
    }
  if (set_described(camera.noise, "noise", rest, text, asked)) return true;
  if (rest != "fov") return false;
  camera.field_of_view =
      within(text, sections::view_angles.minimum, sections::view_angles.maximum, asked);
  return true;
}

/// The thing whose name a key goes on with, and the rest of the key after it.
template <class Things>
auto* named_in(Things& things, const std::string& key, std::string& rest) {
  for (auto& one : things)
    if (key.starts_with(one.name + ".") && key.size() > one.name.size() + 1) {
      rest = key.substr(one.name.size() + 1);
      return &one;
    }
  return static_cast<decltype(&things.front())>(nullptr);
}

/// Every load keeps its size and its other angle.
void set_loads(Scene& scene, bool azimuth, double value) {
  for (SceneLoad& load : scene.loads) {
    const double size = load.force.norm();
    if (!(size > 0.0)) continue;
    const double level = std::hypot(load.force.x(), load.force.y());
    double angle = std::atan2(level, -load.force.z());
    // Straight down or up it has no direction of its own: then that of X.
    double about = level > 1e-12 * size ? std::atan2(load.force.y(), load.force.x()) : 0.0;
    (azimuth ? about : angle) = value;
    load.force = size * Vec3(std::sin(angle) * std::cos(about), std::sin(angle) * std::sin(about),
                             -std::cos(angle));
  }
}

}  // namespace

bool set_place(Scene& scene, const std::string& key, const std::string& text,
               const std::string& given) {
  const std::string asked = given + key;
  std::string rest;
  if (set_described(scene.look, "look", key, text, asked)) return true;
  if (key == "loads.angle" || key == "loads.azimuth") {
    if (scene.loads.empty()) throw UsageError(asked + ": the scene has no loads");
    constexpr double turn = 2.0 * std::numbers::pi;
    set_loads(scene, key == "loads.azimuth", within(text, -turn, turn, asked));
    return true;
  }
  if (key.starts_with("robot.") && scene.robot)
    return set_pose(scene.robot->base, key.substr(6), text, asked);
  if (key.starts_with("plants.")) {
    ScenePlant* plant = named_in(scene.plants, key.substr(7), rest);
    return plant && set_pose(plant->pose, rest, text, asked);
  }
  if (key.starts_with("bodies.")) {
    BodyDescription* body = named_in(scene.bodies, key.substr(7), rest);
    if (body && set_pose(body->pose, rest, text, asked)) return true;
    throw UsageError(asked +
                     ": expected bodies.NAME.position.x (y, z) or bodies.NAME.yaw of a "
                     "body of the scene");
  }
  if (key.starts_with("cameras.")) {
    SceneCamera* camera = named_in(scene.cameras, key.substr(8), rest);
    if (camera && set_camera(*camera, rest, text, asked)) return true;
    throw UsageError(asked +
                     ": expected cameras.NAME.eye.x, cameras.NAME.target.x (y, z), "
                     "cameras.NAME.fov or cameras.NAME.noise.KEY of a camera of the scene");
  }
  for (const InstrumentKind& kind : instrument_kinds()) {
    if (!key.starts_with(kind.section + ".")) continue;
    auto own = of_kind(scene, kind);
    SceneInstrument* one = named_in(own, key.substr(kind.section.size() + 1), rest);
    if (one && set_described(one->noise, "noise", rest, text, asked)) return true;
    throw UsageError(asked + ": expected " + kind.section + ".NAME.noise.KEY of one of the scene");
  }
  return false;
}

std::string place_keys() {
  std::string of_instruments;
  for (const InstrumentKind& kind : instrument_kinds())
    of_instruments += ", " + kind.section + ".NAME.noise.KEY";
  return "plants.NAME.position.x, plants.NAME.yaw, bodies.NAME.position.x, robot.position.x, "
         "cameras.NAME.eye.x, cameras.NAME.target.x, cameras.NAME.fov, cameras.NAME.noise.KEY, "
         "loads.angle, loads.azimuth, look.KEY" +
         of_instruments;
}

}  // namespace pedicel::world
