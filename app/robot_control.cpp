#include "app/robot_control.h"

namespace pedicel::app {

namespace {

robot::RobotSettings settings_of(const world::SceneRobot& scene) {
  robot::RobotSettings settings;
  settings.base_pose = scene.base;
  return settings;
}

/// The link that waypoints move: the scene's, else one called "tool", else the last link.
int tool_of(const world::SceneRobot& scene, const robot::RobotDescription& description) {
  const int named = description.link(scene.tool.empty() ? "tool" : scene.tool);
  return named >= 0 ? named : static_cast<int>(description.links.size()) - 1;
}

}  // namespace

RobotControl::RobotControl(const world::SceneRobot& scene,
                           const robot::RobotDescription& description, world::SimWorld& world)
    : name_(scene.name),
      mode_(scene.control),
      robot_(description, settings_of(scene), world.bullet()),
      reader_(robot_),
      tool_link_(tool_of(scene, description)),
      tool_offset_(scene.tool_offset) {
  q_ = robot_.model().neutral();
  qd_ = Eigen::VectorXd::Zero(q_.size());
  for (const auto& [joint, value] : scene.joints) q_[robot_.model().joint_index(joint)] = value;
  q_ = robot_.model().clamped(q_);
  if (scene.gripper_force > 0.0 && !scene.gripper.empty())
    robot_.set_effort_limit(robot_.model().joint_index(scene.gripper), scene.gripper_force);
  robot_.reset(q_, qd_);
}

void RobotControl::act(world::SimWorld& world, world::StepReport&) {
  if (!trajectory_.empty()) trajectory_.sample(world.time() + world.dt(), q_, qd_);
  for (int i = 0; i < q_.size(); ++i) {
    if (mode_ == "position") robot_.set_position_target(i, q_[i], qd_[i]);
    if (mode_ == "velocity") robot_.set_velocity_target(i, qd_[i]);
    if (mode_ == "torque") robot_.set_torque(i, 0.0);
  }
  robot_.begin_step(world.dt());
}

void RobotControl::Reader::act(world::SimWorld&, world::StepReport& report) {
  robot_.end_step();
  if (!robot_.positions().allFinite()) report.errors |= world::robot_not_finite;
}

Pose RobotControl::tool_pose() const {
  const Pose link = robot_.link_pose_W(tool_link_);
  return {link * tool_offset_, link.rotation};
}

}  // namespace pedicel::app
