#include "app/ros/scene_edits.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/topics/topic_source.h"
#include "engine/core/diagnostics.h"
#include "engine/io/text_file.h"
#include "engine/io/yaml.h"
#include "engine/world/scene_sections.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

namespace {

using Result = ros::SimulationResult;

constexpr double farthest = 1.0e4;  // m, from the origin
constexpr std::size_t longest_name = 100;

/// A pose in the world; nothing where it is none.
std::optional<Pose> pose_in_world(const ros::Header& header, const ros::PoseMessage& message) {
  const ros::Point& p = message.position;
  const ros::Quaternion& q = message.orientation;
  const Vec3 position(p.x, p.y, p.z);
  const Quat rotation(q.w, q.x, q.y, q.z);
  const double size = rotation.norm();
  const bool known = header.frame_id.empty() || header.frame_id == world_frame;
  // What is no number fails every comparison.
  if (!known || !(position.norm() <= farthest) || !(std::abs(size - 1.0) < 0.01)) return {};
  return Pose{position, rotation.normalized()};
}

Vec3 vector_of_message(const ros::Vector3& v) {
  return {v.x, v.y, v.z};
}

bool is_name(const std::string& name) {
  return !name.empty() && name.size() <= longest_name && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

template <class List>
auto named(List& list, const std::string& name) {
  return std::ranges::find_if(list, [&](const auto& one) { return one.name == name; });
}

constexpr const char* pose_fault =
    "the pose, expected one in the frame world, with a unit quaternion, within 10 km";

}  // namespace

SceneEdits::SceneEdits(const world::Scene& scene, const simulation::SimulationOptions& options)
    : first_scene_(scene), first_options_(options), scene_(scene), options_(options) {}

void SceneEdits::reset() {
  scene_ = first_scene_;
  options_ = first_options_;
  edited_ = false;
}

void SceneEdits::take(const SceneEdits& other) {
  scene_ = other.scene_;
  options_ = other.options_;
  edited_ = other.edited_;
}

bool SceneEdits::is_taken(const std::string& name) const {
  return named(scene_.plants, name) != scene_.plants.end() ||
         named(scene_.bodies, name) != scene_.bodies.end() ||
         (scene_.robot && scene_.robot->name == name);
}

std::string SceneEdits::free_name(const std::string& wanted) const {
  const std::string base = wanted.empty() ? "entity" : wanted;
  std::string name = base;
  for (int i = 2; is_taken(name); ++i) name = base + "_" + std::to_string(i);
  return name;
}

Result SceneEdits::add(const std::string& name, const std::string& text,
                       const std::filesystem::path& file, const Pose& pose) {
  Diagnostics diagnostics;
  const std::string source = file.empty() ? "resource_string" : file.string();
  const io::YamlNode root = io::parse_yaml(text, source, diagnostics);
  const auto faulty = [&]() -> Result {
    return {ros::SpawnEntity::resource_parse_error, diagnostics.text()};
  };
  if (diagnostics.has_errors()) return faulty();
  if (!root.is_map())
    return {ros::SpawnEntity::unsupported_format,
            "the resource, expected a plant file (format: pedicel-plant) or a body as in a scene's "
            "bodies"};
  const YAML::Node format = root.raw()["format"];
  if (!format) {
    world::BodyDescription body = world::sections::read_body(root);
    if (diagnostics.has_errors()) return faulty();
    body.name = name;
    body.pose = pose;
    scene_.bodies.push_back(std::move(body));
    edited_ = true;
    return {};
  }
  if (!format.IsScalar() || format.Scalar() != "pedicel-plant")
    return {ros::SpawnEntity::unsupported_format,
            "the resource's format, expected pedicel-plant, or a body without format"};
  auto plant = plant::parse_plant(text, source, diagnostics);
  if (!plant) return faulty();
  world::ScenePlant in_scene;
  in_scene.name = name;
  in_scene.file = file.empty() ? scene_.file : file;  // where leaf templates are looked for
  in_scene.pose = pose;
  scene_.plants.push_back(std::move(in_scene));
  options_.edited[name] = std::move(*plant);
  edited_ = true;
  return {};
}

ros::SpawnEntity::Response SceneEdits::spawn(const ros::SpawnEntity::Request& request) {
  using Spawn = ros::SpawnEntity;
  const auto refuse = [](std::uint8_t code, const std::string& why) {
    return Spawn::Response{{code, why}, ""};
  };
  std::string name = request.entity;
  if (request.allow_renaming && (name.empty() || is_taken(name))) name = free_name(name);
  if (!is_name(name))
    return refuse(Spawn::name_invalid, "the name, expected letters, digits and _, 100 at most");
  if (is_taken(name))
    return refuse(Spawn::name_not_unique, "there is an entity of that name, expected another");
  if (!request.entity_namespace.empty())
    return refuse(Spawn::namespace_invalid,
                  "entity_namespace, expected none: plants and bodies "
                  "have no topics of their own");
  const auto pose = pose_in_world(request.initial_pose.header, request.initial_pose.pose);
  if (!pose) return refuse(Spawn::invalid_pose, pose_fault);
  std::string text = request.entity_resource.resource_string;
  std::filesystem::path file;
  if (std::string uri = request.entity_resource.uri; !uri.empty()) {
    if (uri.starts_with("file://")) uri = uri.substr(7);
    file = std::filesystem::path(uri).is_absolute() ? std::filesystem::path(uri)
                                                    : scene_.file.parent_path() / uri;
    // A pipe or a terminal would be waited for.
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none))
      return refuse(Spawn::resource_parse_error, file.string() + ": expected a file");
    try {
      text = io::read_text_file(file);
    } catch (const std::exception& fault) {
      return refuse(Spawn::resource_parse_error, fault.what());
    }
  }
  if (text.empty()) return refuse(Spawn::no_resource, "neither uri nor resource_string");
  try {
    const Result result = add(name, text, file, *pose);
    return {result, result.result == Result::ok ? name : ""};
  } catch (const InvalidFile& fault) {  // no YAML at all
    return refuse(Spawn::resource_parse_error, fault.what());
  }
}

Result SceneEdits::remove(const std::string& entity) {
  if (const auto plant = named(scene_.plants, entity); plant != scene_.plants.end()) {
    scene_.plants.erase(plant);
    options_.edited.erase(entity);
    edited_ = true;
    return {};
  }
  if (const auto body = named(scene_.bodies, entity); body != scene_.bodies.end()) {
    scene_.bodies.erase(body);
    edited_ = true;
    return {};
  }
  if (scene_.robot && scene_.robot->name == entity)
    return {Result::unsupported, "the robot stays, expected a plant or a body"};
  return {Result::not_found, "no plant or body of that name"};
}

Result SceneEdits::set_state(const ros::SetEntityState::Request& request) {
  if (request.set_acceleration)
    return {Result::unsupported, "accelerations are not set, expected pose or twist"};
  const auto pose = pose_in_world(request.state.header, request.state.pose);
  if (request.set_pose && !pose) return {ros::SetEntityState::invalid_pose, pose_fault};
  const auto plant = named(scene_.plants, request.entity);
  const auto body = named(scene_.bodies, request.entity);
  const bool is_robot = scene_.robot && scene_.robot->name == request.entity;
  if (plant == scene_.plants.end() && body == scene_.bodies.end() && !is_robot)
    return {Result::not_found, "no plant, body or robot of that name"};
  edited_ = true;
  if (request.set_twist) {
    const Vec3 linear = vector_of_message(request.state.twist.linear),
               angular = vector_of_message(request.state.twist.angular);
    const bool good = linear.norm() < 1.0e3 && angular.norm() < 1.0e4;
    if (body == scene_.bodies.end() || body->mass == 0.0 || !good)
      return {Result::operation_failed,
              "the twist, expected one of a body with mass, below 1000 m/s and 10000 rad/s"};
    body->velocity = linear;
    body->angular_velocity = angular;
  }
  if (!request.set_pose) return {};
  if (plant != scene_.plants.end()) plant->pose = *pose;
  if (body != scene_.bodies.end()) body->pose = *pose;
  if (is_robot) scene_.robot->base = *pose;
  return {};
}

}  // namespace pedicel::app
