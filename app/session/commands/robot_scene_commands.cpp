#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "app/session/session.h"
#include "app/session/session_robot.h"
#include "engine/core/check.h"
#include "engine/io/key.h"
#include "engine/io/thing_bounds.h"
#include "engine/world/scene_reader.h"

/// The robot as a part of the scene, as commands.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

world::SceneRobot& robot_of(Document& document) {
  if (!document.scene->robot)
    throw UsageError("the scene has no robot, expected one (see: add robot)");
  return *document.edit_scene().robot;
}

void check_name(const std::string& name) {
  if (name.empty() || name.find_first_of("/.") != std::string::npos)
    throw UsageError("a robot's name \"" + name + "\", expected one without / and .");
}

void add_robot(Document& document, const Command& c) {
  if (document.scene->robot)
    throw UsageError("the robot \"" + document.scene->robot->name +
                     "\" is there already, expected \"delete robot\" before: a scene has one");
  world::SceneRobot robot;
  robot.file = std::filesystem::absolute(c.word("file")).lexically_normal();
  std::error_code none;
  if (!std::filesystem::is_regular_file(robot.file, none))
    throw UsageError(robot.file.string() + " is not there, expected a URDF file");
  robot.name = c.word_or("name", "robot");
  check_name(robot.name);
  robot.base = read_pose(c);
  robot.tool = c.word_or("tool", "");
  robot.gripper = c.word_or("gripper", "");
  document.edit_scene().robot = std::move(robot);
}

void rename_robot(Document& document, const Command& c) {
  check_name(c.word("to"));
  robot_of(document).name = c.word("to");
}

void set_robot(Document& document, const Command& c) {
  const std::string &key = c.word("key"), &value = c.word("value");
  if (key == "tool")
    robot_of(document).tool = value;
  else if (key == "gripper")
    robot_of(document).gripper = value;
  else if (key == "control" && std::ranges::count(world::scene_key("robot", key).words, value))
    robot_of(document).control = value;
  else
    throw UsageError("\"" + key + " " + value +
                     "\", expected tool LINK, gripper JOINT or control position, velocity or "
                     "torque");
}

void delete_robot(Document& document, const Command&) {
  robot_of(document);
  const std::string by = references_to(document, "robot");
  if (!by.empty())
    throw UsageError("it is meant by " + by + ", expected \"clear references robot\" before");
  document.edit_scene().robot.reset();
  document.waypoints.clear();
}

void clear_program(Document& document, const Command&) {
  world::SceneRobot& robot = robot_of(document);
  if (robot.waypoints.empty() && robot.trajectory.empty())
    throw UsageError("the robot has no program");
  robot.waypoints.clear();
  robot.trajectory.clear();
}

Command complete_robot(Session& session, const Command& c) {
  return session.robot().complete(c);
}

}  // namespace

std::vector<CommandDescription> robot_scene_commands() {
  return {
      {"add robot",
       {{"file", Kind::text, true,
         "path of a URDF, or the name of one that comes with the program"},
        {"name", Kind::word, false, "in the scene (robot)"},
        {"position", Kind::point, false, "m, of its base (where it reaches the plants)",
         io::place_bounds},
        {"turn", Kind::numbers, false, "x,y,z,w, or roll,pitch,yaw in rad (towards the plants)"},
        {"tool", Kind::word, false, "link that is led (the last one, or one that is named so)"},
        {"gripper", Kind::word, false, "joint (one that is named so)"}},
       "Adds a robot.",
       add_robot,
       complete_robot},
      {"move robot",
       {{"to", Kind::point, true, "m, in the world: its base", io::place_bounds}},
       "Puts the robot elsewhere.",
       [](Document& document, const Command& c) {
         robot_of(document).base.position = c.point("to");
       }},
      {"turn robot",
       {{"to", Kind::numbers, true, "x,y,z,w, or roll,pitch,yaw in rad, in the world"}},
       "Turns the robot's base.",
       [](Document& document, const Command& c) {
         robot_of(document).base.rotation = read_turn(c.numbers("to"));
       }},
      {"rename robot", {{"to", Kind::word, true, "its new name"}}, "Names it.", rename_robot},
      {"set robot",
       {{"key", Kind::word, true, "tool, gripper or control"},
        {"value", Kind::text, true, "a link, a joint; position, velocity or torque"}},
       "Says which link is led, which joint grips, and how the joints are driven.",
       set_robot},
      {"set start",
       {{"joint", Kind::word, true, "of the robot"}, {"value", Kind::number, true, "rad or m"}},
       "Sets where a joint begins.",
       [](Document& document, const Command& c) {
         robot_of(document).joints[c.word("joint")] = c.number("value");
       }},
      {"delete robot", {}, "Takes the robot out of the scene.", delete_robot},
      {"clear program",
       {},
       "Takes the robot's program (waypoints of the scene, trajectory) away.",
       clear_program},
  };
}

}  // namespace pedicel::app
