#include "core/check.h"
#include "robot/joint_range.h"
#include "session/robot_goal.h"
#include "session/session.h"

/// The robot by hand.
namespace pedicel::app {

namespace {

int joint_of(const robot::KinematicModel& model, const std::string& name) {
  const int joint = model.joint_index(name);
  if (joint >= 0) return joint;
  std::string names;
  for (const std::string& one : model.joint_names()) names += (names.empty() ? "" : ", ") + one;
  throw UsageError("no joint \"" + name + "\", expected one of: " + names);
}

void check_limits(const robot::KinematicModel& model, const Eigen::VectorXd& q) {
  constexpr double slack = 1e-6;  // rad or m, of numbers that were rounded to be shown
  for (int i = 0; i < model.dofs(); ++i) {
    if (const auto fault = robot::outside_range(model, i, q[i], slack))
      throw UsageError("joint " + *fault);
  }
}

}  // namespace

robot::IkResult Session::reach(const Pose& tool_W, bool turned) const {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  const world::SceneRobot& scene = *now->assets->scene.robot;
  robot::IkTarget target;
  target.link = now->robot.tool_link;
  target.position_W = tool_W.position - tool_W.rotation * scene.tool_offset;
  if (turned) target.orientation_W = tool_W.rotation;
  robot::IkSettings settings;
  settings.restarts = 6;
  settings.loyalty = 0.1;
  if (!scene.gripper.empty()) settings.held = {joint_of(model, scene.gripper)};
  return robot::inverse_kinematics(model, target, start_of(now->robot), settings);
}

Result Session::move_joints(const Eigen::VectorXd& q) {
  const robot::KinematicModel model = kinematics_of(*snapshot());
  if (q.size() != model.dofs())
    throw UsageError(std::to_string(q.size()) + " values, expected " +
                     std::to_string(model.dofs()) + ", one a joint");
  check_limits(model, q);
  control_.move_robot(q);
  return {};
}

// The pose that was asked for is known as long as the robot goes where that has sent it, or is yet
// to hear of it.
std::optional<ToolGoal> Session::tool_goal() const {
  const auto now = snapshot();
  if (!now->robot.present || !now->assets || !now->assets->robot) return {};
  if (aim_ && aim_->stage == now->stage && now->step >= aim_->step &&
      (now->robot.goal == aim_->to || now->number <= aim_->number))
    return aim_->goal;
  const robot::KinematicModel model = kinematics_of(*now);
  const Pose tool = tool_at(*now, model, start_of(now->robot));
  return ToolGoal{tool, tool, true, {}};
}

Result Session::aim_tool(const Pose& tool_W, bool turned, bool as_near_as_can_be) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  // With fewer than six joints a place alone can be asked for.
  const bool holds_turn = turned || tool_freedom(*now, model) >= 6;
  const robot::IkResult found = reach(tool_W, holds_turn);
  if (!found.reached && !as_near_as_can_be) return {false, found.sentence};
  Aim aim;
  aim.to = model.clamped(found.q);
  aim.goal = {tool_W, tool_at(*now, model, aim.to), found.reached, found.sentence};
  if (!holds_turn) aim.goal.asked_W.rotation = aim.goal.nearest_W.rotation;
  if (found.reached) aim.goal.nearest_W = aim.goal.asked_W;
  aim.stage = now->stage, aim.step = now->step, aim.number = now->number;
  const Result moved = move_joints(found.q);
  aim_ = std::move(aim);
  return moved.ok ? Result{true, found.sentence} : moved;
}

Result Session::jog(const Vec3& shift_W, const Vec3& turn_W) {
  const std::optional<ToolGoal> goal = tool_goal();
  if (!goal) throw UsageError("the scene has no robot");
  Pose tool = goal->nearest_W;
  tool.position += shift_W;
  const double angle = turn_W.norm();
  if (angle > 0.0)
    tool.rotation = (Eigen::AngleAxisd(angle, turn_W / angle) * tool.rotation).normalized();
  return aim_tool(tool, angle > 0.0, false);
}

Result Session::tool_command(const Command& c) {
  const std::optional<ToolGoal> goal = tool_goal();
  if (!goal) throw UsageError("the scene has no robot");
  Pose tool = goal->asked_W;
  tool.position = c.point("to");
  if (c.has("turn")) {
    if (c.numbers("turn").size() != 4) throw UsageError("turn, expected x,y,z,w");
    const Quat turn(c.numbers("turn").data());
    if (!(turn.norm() > 1e-9)) throw UsageError("turn, expected x,y,z,w that are not all 0");
    tool.rotation = turn.normalized();
  }
  return aim_tool(tool, c.has("turn"), c.whole_or("near", 0) != 0);
}

Result Session::robot_command(const Command& c) {
  const std::string& verb = c.verb();
  const auto now = snapshot();
  if (verb == "joint" || verb == "gripper") {
    const robot::KinematicModel model = kinematics_of(*now);
    const std::string name = verb == "joint" ? c.word("name") : now->assets->scene.robot->gripper;
    Eigen::VectorXd q = start_of(now->robot);
    q[joint_of(model, name)] = c.number("value");
    return move_joints(q);
  }
  if (verb == "joints") {
    const std::vector<double>& values = c.numbers("values");
    return move_joints(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  }
  if (verb == "jog") return jog(c.point("shift"), c.has("turn") ? c.point("turn") : Vec3::Zero());
  if (verb == "tool") return tool_command(c);
  return program_command(c);
}

}  // namespace pedicel::app
