#include "app/session/commands/command_table.h"
#include "app/session/session.h"
#include "app/session/session_robot.h"
#include "engine/core/check.h"
#include "engine/io/thing_bounds.h"

/// The robot by hand, and what it plays.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

bool loops(const Command& c) {
  return c.whole_or("loop", 0) != 0;
}

Result move_all_joints(Session& session, const Command& c) {
  const std::vector<double>& values = c.numbers("values");
  return session.robot().move_joints(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
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

}  // namespace

std::vector<CommandDescription> robot_commands() {
  const ArgumentDescription loop{"loop", Kind::whole, false, "1: over and over until stopped (0)"};
  return {
      {"joint",
       {{"name", Kind::word, true, "of the joint"}, {"value", Kind::number, true, "rad or m"}},
       "Moves one joint.",
       [](Session& session, const Command& c) {
         return session.robot().move_joint(c.word("name"), c.number("value"));
       }},
      {"joints",
       {{"values", Kind::numbers, true, "rad or m, one a joint"}},
       "Moves all joints.",
       move_all_joints},
      {"jog",
       {{"shift", Kind::point, true, "m, in the world"},
        {"turn", Kind::point, false, "rad, a rotation vector in the world"}},
       "Moves the tool a little.",
       [](Session& session, const Command& c) {
         return session.robot().jog(c.point("shift"),
                                    c.has("turn") ? c.point("turn") : Vec3::Zero());
       }},
      {"tool",
       {{"to", Kind::point, true, "m, in the world", io::place_bounds},
        {"turn", Kind::numbers, false, "x,y,z,w: its orientation (as it is to be now)"},
        {"near", Kind::whole, false, "1: as near as can be where it is out of reach (0: refused)"}},
       "Moves the tool to a place.",
       move_tool},
      {"gripper",
       {{"value", Kind::number, true, "m or rad, of the gripper's joint"}},
       "Opens or closes the gripper.",
       [](Session& session, const Command& c) {
         return session.robot().move_gripper(c.number("value"));
       }},
      {"pick",
       {{"organ", Kind::word, true, "PLANT/FRUIT"},
        {"pull", Kind::point, false,
         "m, where it is pulled to from there (up, as far as the arm comes)"}},
       "Leads the tool to a fruit, shuts the gripper on it and pulls.",
       [](Session& session, const Command& c) {
         return session.robot().pick(
             c.word("organ"), c.has("pull") ? std::optional<Vec3>(c.point("pull")) : std::nullopt);
       }},
      {"play trajectory",
       {{"file", Kind::text, true, "table time_s,JOINT,... in rad or m"}, loop},
       "Plays joint positions from a file, from now on.",
       [](Session& session, const Command& c) {
         return session.robot().play_trajectory(c.word("file"), loops(c));
       }},
      {"play waypoints",
       {loop},
       "Plays the recorded waypoints from now on.",
       [](Session& session, const Command& c) { return session.robot().play_waypoints(loops(c)); }},
      {"home robot",
       {},
       "Moves all joints to where they start.",
       [](Session& session, const Command&) { return session.robot().home(); }},
      {"stop robot",
       {},
       "Ends what the robot plays: it stays where it is.",
       [](Session& session, const Command&) { return session.robot().stop(); }},
  };
}

}  // namespace pedicel::app
