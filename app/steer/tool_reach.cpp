#include "app/steer/tool_reach.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace pedicel::app {

namespace {

Pose tool_at(const simulation::RobotControl& robot, const Eigen::VectorXd& q, const Vec3& offset) {
  const Pose link = robot.robot().model().link_pose(q, robot.tool_link());
  return {link * offset, link.rotation};
}

// In small steps, each from the last one's joints: one descent over a wide turn ends in another
// branch, and the arm flips over.
robot::IkResult lead(const robot::KinematicModel& model, robot::IkTarget target, const Pose& from,
                     const Vec3& offset, Eigen::VectorXd q, const robot::IkSettings& settings) {
  constexpr double turn = 0.2, way = 0.05;  // rad, m, of a step
  const Vec3 begin = from.position - from.rotation * offset, end = target.position_W;
  const Quat last = target.orientation_W.value_or(from.rotation);
  const double asked =
      std::max(from.rotation.angularDistance(last) / turn, (end - begin).norm() / way);
  const int steps = std::clamp(static_cast<int>(std::ceil(asked)), 1, 60);
  robot::IkResult result;
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    target.position_W = i == steps ? end : Vec3(begin + share * (end - begin));
    if (target.orientation_W)
      target.orientation_W = i == steps ? last : from.rotation.slerp(share, last);
    result = robot::descend(model, target, q, settings);
    if (!result.reached) break;
    q = result.q;
  }
  return result;
}

}  // namespace

const simulation::RobotControl& robot_of(const simulation::Simulation& simulation) {
  if (!simulation.robot()) throw UsageError("the scene has no robot, expected one");
  return *simulation.robot();
}

robot::IkResult reach_tool(const simulation::Simulation& simulation, const Vec3& position_W,
                           const std::optional<Quat>& orientation_W, const Eigen::VectorXd& start) {
  const simulation::RobotControl& robot = robot_of(simulation);
  const robot::KinematicModel& model = robot.robot().model();
  const Vec3& offset = simulation.scene().robot->tool_offset;
  const Pose now = tool_at(robot, start, offset);
  robot::IkTarget target;
  target.link = robot.tool_link();
  target.position_W = position_W - orientation_W.value_or(now.rotation) * offset;
  target.orientation_W = orientation_W;
  robot::IkSettings settings;
  settings.restarts = 6;
  settings.start_preference = 0.1;
  if (robot.gripper() >= 0) settings.held = {robot.gripper()};
  const robot::IkResult led = lead(model, target, now, offset, start, settings);
  if (led.reached) return led;
  const std::vector<Eigen::VectorXd> others = robot::ik_solutions(model, target, start, settings);
  if (others.empty()) return robot::inverse_kinematics(model, target, start, settings);
  return robot::descend(model, target, others.front(), settings);
}

}  // namespace pedicel::app
