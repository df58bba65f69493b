#include <map>

#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "engine/core/check.h"
#include "engine/io/thing_bounds.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"

/// What a scene is built of beside its plants, as commands: bodies, ground, cameras, robot.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;
using world::BodyDescription;
using world::BodyPart;

void add(Document& document, const Command& c, std::vector<BodyPart> parts) {
  check_new_name(document, ThingKind::body, c.word("body"));
  BodyDescription body;
  body.name = c.word("body");
  body.parts = std::move(parts);
  body.pose = read_pose(c);
  body.mass = c.number_or("mass", 0.0);
  body.look = c.word_or("look", body.look);
  document.edit_scene().bodies.push_back(std::move(body));
}

void add_box(Document& document, const Command& c) {
  BodyPart part;
  part.half_extents = 0.5 * c.point("size");
  add(document, c, {part});
}

void add_round(Document& document, const Command& c, BodyPart::Kind kind) {
  BodyPart part;
  part.kind = kind;
  part.radius = c.number("radius");
  if (kind != BodyPart::Kind::sphere) part.length = c.number("length");
  add(document, c, {part});
}

std::vector<BodyPart> tray(const Vec3& size, double wall) {
  if (2.0 * wall >= size.minCoeff())
    throw UsageError("wall, expected m below half the tray's size");
  return world::tray_parts(size, wall);
}

/// The extents of a body by their names; false: it has none of that name.
bool set_extent(BodyDescription& body, const std::string& key, double value) {
  Vec3 size;
  double wall = 0.0;
  const int axis = key == "size_x" ? 0 : key == "size_y" ? 1 : key == "size_z" ? 2 : -1;
  if (world::is_tray(body, size, wall)) {
    if (axis >= 0)
      size[axis] = value;
    else if (key == "wall")
      wall = value;
    else
      return false;
    body.parts = tray(size, wall);
    return true;
  }
  BodyPart& part = body.parts.front();
  const bool box = part.kind == BodyPart::Kind::box;
  if (box && axis >= 0)
    part.half_extents[axis] = 0.5 * value;
  else if (!box && key == "radius")
    part.radius = value;
  else if (!box && key == "length" && part.kind != BodyPart::Kind::sphere)
    part.length = value;
  else
    return false;
  return true;
}

void set_body(Document& document, const Command& c) {
  const std::size_t index = index_of(document, ThingKind::body, c.word("body"));
  BodyDescription& body = document.edit_scene().bodies[index];
  const std::string& key = c.word("key");
  const double value = c.number("value");
  const std::map<std::string, double*> numbers = {
      {"mass", &body.mass}, {"friction", &body.friction}, {"restitution", &body.restitution}};
  const auto number = numbers.find(key);
  const bool is_extent = number == numbers.end();
  const ArgumentDescription extent{key, Kind::number, true, "m", io::extent_bounds};
  check_within(key, value, is_extent ? extent : argument_of("body", key, true));
  if (!is_extent)
    *number->second = value;
  else if (!set_extent(body, key, value))
    throw UsageError("\"" + key + "\" of \"" + body.name +
                     "\", expected mass, friction, restitution or an extent that it has: size_x, "
                     "size_y, size_z, radius, length, wall");
}

void set_body_look(Document& document, const Command& c) {
  const std::size_t index = index_of(document, ThingKind::body, c.word("body"));
  document.edit_scene().bodies[index].look = c.word("look");
}

void set_ground(Document& document, const Command& c) {
  world::GroundPlane ground = document.scene->ground.value_or(world::GroundPlane{});
  ground.height = c.number_or("height", ground.height);
  ground.friction = c.number_or("friction", ground.friction);
  ground.restitution = c.number_or("restitution", ground.restitution);
  document.edit_scene().ground = ground;
}

void delete_ground(Document& document, const Command&) {
  if (!document.scene->ground) throw UsageError("there is no ground to take away");
  document.edit_scene().ground.reset();
}

void put_camera(world::SceneCamera& camera, const Command& c) {
  camera.eye = c.point("eye");
  camera.target = c.point("target");
  camera.field_of_view = c.number_or("fov", camera.field_of_view);
  if (!((camera.eye - camera.target).norm() > 1e-6))
    throw UsageError("eye and target, expected them to be apart");
}

void add_camera(Document& document, const Command& c) {
  check_new_name(document, ThingKind::camera, c.word("camera"));
  world::SceneCamera camera;
  camera.name = c.word("camera");
  put_camera(camera, c);
  document.edit_scene().cameras.push_back(camera);
}

void move_camera(Document& document, const Command& c) {
  const std::size_t index = index_of(document, ThingKind::camera, c.word("camera"));
  put_camera(document.edit_scene().cameras[index], c);
}

/// Everything but the plants, as a scene file says it.
void set_scene(Document& document, const Command& c) {
  Diagnostics diagnostics;
  auto scene = world::parse_scene(c.word("text"), "scene", diagnostics);
  if (!scene) throw UsageError(sentences(diagnostics.all()));
  scene->file = document.scene->file;
  scene->plants = document.scene->plants;
  scene->name = document.scene->name;
  document.scene = std::make_shared<const world::Scene>(std::move(*scene));
}

std::vector<CommandDescription> body_commands() {
  const ArgumentDescription name{"body", Kind::word, true, "name of the body"};
  const ArgumentDescription size{"size", Kind::point, true, "m, along its x, y, z",
                                 io::extent_bounds};
  const ArgumentDescription radius = argument_of("round", "radius", true);
  const ArgumentDescription length = argument_of("round", "length", true);
  const std::vector<ArgumentDescription> others = {
      {"position", Kind::point, false, "m, in the world (the origin)", io::place_bounds},
      {"turn", Kind::numbers, false, "x,y,z,w, or roll,pitch,yaw in rad (none)"},
      argument_of("body", "mass", false),
      argument_of("body", "look", false)};
  const auto with = [&](std::vector<ArgumentDescription> arguments) {
    arguments.insert(arguments.begin(), name);
    arguments.insert(arguments.end(), others.begin(), others.end());
    return arguments;
  };
  return {
      {"add box", with({size}), "Adds a box; its place is its middle.", add_box},
      {"add sphere", with({radius}), "Adds a sphere.",
       [](Document& document, const Command& c) {
         add_round(document, c, BodyPart::Kind::sphere);
       }},
      {"add cylinder", with({radius, length}), "Adds a cylinder.",
       [](Document& document, const Command& c) {
         add_round(document, c, BodyPart::Kind::cylinder);
       }},
      {"add capsule", with({radius, length}),
       "Adds a cylinder with round ends; its length is without them.",
       [](Document& document, const Command& c) {
         add_round(document, c, BodyPart::Kind::capsule);
       }},
      {"add tray", with({size, argument_of("tray", "wall", true)}),
       "Adds an open box; its place is the middle of its lower face.",
       [](Document& document, const Command& c) {
         add(document, c, tray(c.point("size"), c.number("wall")));
       }},
      {"set body",
       {name,
        {"key", Kind::word, true,
         "mass (kg), friction, restitution, size_x, size_y, size_z, radius, length, wall (m)"},
        {"value", Kind::number, true, "of the key"}},
       "Sets a number of a body.",
       set_body},
      {"set look",
       {name, argument_of("body", "look", true)},
       "Sets how a body is drawn.",
       set_body_look},
  };
}

}  // namespace

std::vector<CommandDescription> scene_commands() {
  const ArgumentDescription camera{"camera", Kind::word, true, "name of the camera"};
  const std::vector<ArgumentDescription> view = {camera, argument_of("camera", "eye", true),
                                                 argument_of("camera", "target", true),
                                                 argument_of("camera", "fov", false)};
  std::vector<CommandDescription> table = body_commands();
  const std::vector<CommandDescription> others = {
      {"set ground",
       {argument_of("ground", "height", false), argument_of("ground", "friction", false),
        argument_of("ground", "restitution", false)},
       "Puts the ground there, where there is none, too.",
       set_ground},
      {"delete ground", {}, "Takes the ground away.", delete_ground},
      {"add camera", view, "Adds a camera.", add_camera},
      {"move camera", view, "Puts a camera elsewhere.", move_camera},
      {"set scene",
       {{"text", Kind::text, true, "of a scene file, lines ended by \\n, paths whole"}},
       "Makes robot, bodies, ground, cameras and the rest what a scene file says; plants stay.",
       set_scene},
  };
  table.insert(table.end(), others.begin(), others.end());
  return table;
}

}  // namespace pedicel::app
