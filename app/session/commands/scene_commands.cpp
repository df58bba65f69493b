#include <algorithm>
#include <cmath>

#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/io/thing_bounds.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"

/// What a scene is built of beside its plants, as commands: bodies, ground, cameras, robot.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;
using world::BodyDescription;
using world::BodyPart;

double above_zero(const Command& c, const std::string& name, const std::string& unit) {
  const double value = c.number(name);
  if (!io::within(value, io::extent_bounds))
    throw UsageError(name + " " + io::format_number(value) + ", expected " + unit +
                     " above 0, at most " + io::format_number(io::extent_bounds.maximum));
  return value;
}

Vec3 size_of(const Command& c) {
  const Vec3 size = c.point("size");
  if (!io::within(size.minCoeff(), io::extent_bounds) ||
      !io::within(size.maxCoeff(), io::extent_bounds))
    throw UsageError("size, expected three numbers above 0, at most " +
                     io::format_number(io::extent_bounds.maximum) + ", in m");
  return size;
}

void check_mass(double mass) {
  if (!io::within(mass, io::mass_bounds))
    throw UsageError("mass " + io::format_number(mass) + ", expected kg from 0 to " +
                     io::format_number(io::mass_bounds.maximum));
}

void set_look(BodyDescription& body, const std::string& look) {
  if (std::ranges::find(world::body_looks(), look) == world::body_looks().end()) {
    std::string looks;
    for (const std::string& one : world::body_looks()) looks += (looks.empty() ? "" : ", ") + one;
    throw UsageError("look \"" + look + "\", expected one of: " + looks);
  }
  body.look = look;
}

void add(Document& document, const Command& c, std::vector<BodyPart> parts) {
  check_new_name(document, ThingKind::body, c.word("body"));
  BodyDescription body;
  body.name = c.word("body");
  body.parts = std::move(parts);
  body.pose = read_pose(c);
  body.mass = c.number_or("mass", 0.0);
  check_mass(body.mass);
  if (c.has("look")) set_look(body, c.word("look"));
  document.edit_scene().bodies.push_back(std::move(body));
}

void add_box(Document& document, const Command& c) {
  BodyPart part;
  part.half_extents = 0.5 * size_of(c);
  add(document, c, {part});
}

void add_round(Document& document, const Command& c, BodyPart::Kind kind) {
  BodyPart part;
  part.kind = kind;
  part.radius = above_zero(c, "radius", "m");
  if (kind != BodyPart::Kind::sphere) part.length = above_zero(c, "length", "m");
  add(document, c, {part});
}

void add_sphere(Document& document, const Command& c) {
  add_round(document, c, BodyPart::Kind::sphere);
}
void add_cylinder(Document& document, const Command& c) {
  add_round(document, c, BodyPart::Kind::cylinder);
}
void add_capsule(Document& document, const Command& c) {
  add_round(document, c, BodyPart::Kind::capsule);
}

std::vector<BodyPart> tray(const Vec3& size, double wall) {
  if (!(wall > 0.0) || 2.0 * wall >= size.minCoeff())
    throw UsageError("wall, expected m above 0 and below half the tray's size");
  return world::tray_parts(size, wall);
}

void add_tray(Document& document, const Command& c) {
  add(document, c, tray(size_of(c), c.number("wall")));
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
  if (!std::isfinite(value)) throw UsageError(key + ", expected a finite number");
  const bool at_least_0 = value >= 0.0;
  if (key == "mass" && at_least_0)
    check_mass(value), body.mass = value;
  else if (key == "friction" && at_least_0)
    body.friction = value;
  else if (key == "restitution" && at_least_0 && value <= 1.0)
    body.restitution = value;
  else if (key == "mass" || key == "friction" || key == "restitution")
    throw UsageError(key + " " + io::format_number(value) + ", expected 0 or more" +
                     (key == "restitution" ? ", at most 1" : ""));
  else if (!io::within(value, io::extent_bounds))
    throw UsageError(key + " " + io::format_number(value) + ", expected m above 0, at most " +
                     io::format_number(io::extent_bounds.maximum));
  else if (!set_extent(body, key, value))
    throw UsageError("\"" + key + "\" of \"" + body.name +
                     "\", expected mass, friction, restitution or an extent that it has: size_x, "
                     "size_y, size_z, radius, length, wall");
}

void set_body_look(Document& document, const Command& c) {
  const std::size_t index = index_of(document, ThingKind::body, c.word("body"));
  set_look(document.edit_scene().bodies[index], c.word("look"));
}

void set_ground(Document& document, const Command& c) {
  world::GroundPlane ground = document.scene->ground.value_or(world::GroundPlane{});
  ground.height = c.number_or("height", ground.height);
  ground.friction = c.number_or("friction", ground.friction);
  ground.restitution = c.number_or("restitution", ground.restitution);
  if (!io::within(ground.height, io::place_bounds))
    throw UsageError("height " + io::format_number(ground.height) +
                     ", expected m: " + io::bounds_text(io::place_bounds));
  if (!(ground.friction >= 0.0)) throw UsageError("friction, expected 0 or more");
  if (!io::within(ground.restitution, io::fraction))
    throw UsageError("restitution " + io::format_number(ground.restitution) +
                     ", expected one: " + io::bounds_text(io::fraction));
  document.edit_scene().ground = ground;
}

void delete_ground(Document& document, const Command&) {
  if (!document.scene->ground) throw UsageError("there is no ground to take away");
  document.edit_scene().ground.reset();
}

void put_camera(world::SceneCamera& camera, const Command& c) {
  camera.eye = read_place(c, "eye");
  camera.target = read_place(c, "target");
  camera.field_of_view = c.number_or("fov", camera.field_of_view);
  if (!((camera.eye - camera.target).norm() > 1e-6))
    throw UsageError("eye and target, expected them to be apart");
  if (!(camera.field_of_view >= 0.01 && camera.field_of_view <= 3.0))
    throw UsageError("fov, expected rad from 0.01 to 3");
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
  const Scope d = Scope::document;
  const ArgumentDescription name{"body", Kind::word, true, "name of the body"};
  const ArgumentDescription size{"size", Kind::point, true, "m, along its x, y, z"};
  const ArgumentDescription radius{"radius", Kind::number, true, "m"};
  const ArgumentDescription length{"length", Kind::number, true, "m, along its z"};
  const std::vector<ArgumentDescription> others = {
      {"position", Kind::point, false, "m, in the world (the origin)"},
      {"turn", Kind::numbers, false, "x,y,z,w, or roll,pitch,yaw in rad (none)"},
      {"mass", Kind::number, false, "kg; 0 does not move (0)"},
      {"look", Kind::word, false, "steel, wood, light, dark, accent, hidden (steel)"}};
  const auto with = [&](std::vector<ArgumentDescription> arguments) {
    arguments.insert(arguments.begin(), name);
    arguments.insert(arguments.end(), others.begin(), others.end());
    return arguments;
  };
  return {
      {"add box", d, with({size}), "Adds a box; its place is its middle.", add_box},
      {"add sphere", d, with({radius}), "Adds a sphere.", add_sphere},
      {"add cylinder", d, with({radius, length}), "Adds a cylinder.", add_cylinder},
      {"add capsule", d,
       with({radius, {"length", Kind::number, true, "m, along its z, without its caps"}}),
       "Adds a cylinder with round ends.", add_capsule},
      {"add tray", d, with({size, {"wall", Kind::number, true, "m, thickness"}}),
       "Adds an open box; its place is the middle of its lower face.", add_tray},
      {"set body",
       d,
       {name,
        {"key", Kind::word, true,
         "mass (kg), friction, restitution, size_x, size_y, size_z, radius, length, wall (m)"},
        {"value", Kind::number, true, "of the key"}},
       "Sets a number of a body.",
       set_body},
      {"set look",
       d,
       {name, {"look", Kind::word, true, "steel, wood, light, dark, accent, hidden"}},
       "Sets how a body is drawn.",
       set_body_look},
  };
}

}  // namespace

std::vector<CommandDescription> scene_commands() {
  const Scope d = Scope::document;
  const ArgumentDescription camera{"camera", Kind::word, true, "name of the camera"};
  const ArgumentDescription eye{"eye", Kind::point, true, "m, where it stands"};
  const ArgumentDescription target{"target", Kind::point, true, "m, what it looks at"};
  const ArgumentDescription fov{"fov", Kind::number, false, "rad, vertical (0.7)"};
  std::vector<CommandDescription> table = body_commands();
  const std::vector<CommandDescription> others = {
      {"set ground",
       d,
       {{"height", Kind::number, false, "m (0)"},
        {"friction", Kind::number, false, "1 (0.8)"},
        {"restitution", Kind::number, false, "1 (0)"}},
       "Puts the ground there, where there is none, too.",
       set_ground},
      {"delete ground", d, {}, "Takes the ground away.", delete_ground},
      {"add camera", d, {camera, eye, target, fov}, "Adds a camera.", add_camera},
      {"move camera", d, {camera, eye, target, fov}, "Puts a camera elsewhere.", move_camera},
      {"set scene",
       d,
       {{"text", Kind::text, true, "of a scene file, lines ended by \\n, paths whole"}},
       "Makes robot, bodies, ground, cameras and the rest what a scene file says; plants stay.",
       set_scene},
  };
  table.insert(table.end(), others.begin(), others.end());
  return table;
}

}  // namespace pedicel::app
