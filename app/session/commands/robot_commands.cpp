#include "app/session/commands/command_table.h"
#include "app/session/session.h"
#include "app/session/session_robot.h"
#include "engine/core/check.h"

/// The robot by hand, and what it plays.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

bool loops(const Command& c) {
  return c.whole_or("loop", 0) != 0;
}

Result move_joint(Session& session, const Command& c) {
  return session.robot().move_joint(c.word("name"), c.number("value"));
}

Result move_gripper(Session& session, const Command& c) {
  return session.robot().move_gripper(c.number("value"));
}

Result move_all_joints(Session& session, const Command& c) {
  const std::vector<double>& values = c.numbers("values");
  return session.robot().move_joints(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

Result jog_tool(Session& session, const Command& c) {
  return session.robot().jog(c.point("shift"), c.has("turn") ? c.point("turn") : Vec3::Zero());
}

Result move_tool(Session& session, const Command& c) {
  const std::optional<ToolGoal> goal = session.robot().tool_goal();
  if (!goal) throw UsageError("the scene has no robot");
  Pose tool = goal->asked_W;
  tool.position = c.point("to");
  if (c.has("turn")) {
    if (c.numbers("turn").size() != 4) throw UsageError("turn, expected x,y,z,w");
    const Quat turn(c.numbers("turn").data());
    if (!(turn.norm() > 1e-9)) throw UsageError("turn, expected x,y,z,w that are not all 0");
    tool.rotation = turn.normalized();
  }
  return session.robot().aim_tool(tool, c.has("turn"), c.whole_or("near", 0) != 0);
}

Result pick_fruit(Session& session, const Command& c) {
  return session.robot().pick(c.word("organ"),
                              c.has("pull") ? std::optional<Vec3>(c.point("pull")) : std::nullopt);
}

Result play_table(Session& session, const Command& c) {
  return session.robot().play_trajectory(c.word("file"), loops(c));
}

Result play_recorded(Session& session, const Command& c) {
  return session.robot().play_waypoints(loops(c));
}

Result home_robot(Session& session, const Command&) {
  return session.robot().home();
}

Result stop_robot(Session& session, const Command&) {
  return session.robot().stop();
}

}  // namespace

std::vector<CommandDescription> robot_commands() {
  const Scope r = Scope::run;
  const ArgumentDescription loop{"loop", Kind::whole, false, "1: over and over until stopped (0)"};
  return {
      {"joint",
       r,
       {{"name", Kind::word, true, "of the joint"}, {"value", Kind::number, true, "rad or m"}},
       "Moves one joint.",
       move_joint},
      {"joints",
       r,
       {{"values", Kind::numbers, true, "rad or m, one a joint"}},
       "Moves all joints.",
       move_all_joints},
      {"jog",
       r,
       {{"shift", Kind::point, true, "m, in the world"},
        {"turn", Kind::point, false, "rad, a rotation vector in the world"}},
       "Moves the tool a little.",
       jog_tool},
      {"tool",
       r,
       {{"to", Kind::point, true, "m, in the world"},
        {"turn", Kind::numbers, false, "x,y,z,w: its orientation (as it is to be now)"},
        {"near", Kind::whole, false, "1: as near as can be where it is out of reach (0: refused)"}},
       "Moves the tool to a place.",
       move_tool},
      {"gripper",
       r,
       {{"value", Kind::number, true, "m or rad, of the gripper's joint"}},
       "Opens or closes the gripper.",
       move_gripper},
      {"pick",
       r,
       {{"organ", Kind::word, true, "PLANT/FRUIT"},
        {"pull", Kind::point, false,
         "m, where it is pulled to from there (up, as far as the arm comes)"}},
       "Leads the tool to a fruit, shuts the gripper on it and pulls.",
       pick_fruit},
      {"play trajectory",
       r,
       {{"file", Kind::text, true, "table time_s,JOINT,... in rad or m"}, loop},
       "Plays joint positions from a file, from now on.",
       play_table},
      {"play waypoints", r, {loop}, "Plays the recorded waypoints from now on.", play_recorded},
      {"home robot", r, {}, "Moves all joints to where they start.", home_robot},
      {"stop robot", r, {}, "Ends what the robot plays: it stays where it is.", stop_robot},
  };
}

}  // namespace pedicel::app
