#include "app/session/live/robot_goal.h"

#include "engine/core/check.h"

namespace pedicel::app {

namespace {

constexpr double near_turn = 0.02, near_slide = 0.003;  // rad, m

bool is_gripper(const Snapshot& now, const robot::KinematicModel& model, int dof) {
  return model.joint_names()[static_cast<std::size_t>(dof)] == now.assets->scene.robot->gripper;
}

bool is_there(const Snapshot& now, const robot::KinematicModel& model) {
  const robot::RobotDescription& description = *now.assets->robot;
  for (int i = 0; i < model.dofs(); ++i) {
    // A gripper that holds something is never where it is sent.
    if (is_gripper(now, model, i)) continue;
    const int joint = description.joint(model.joint_names()[static_cast<std::size_t>(i)]);
    const bool slides =
        description.joints[static_cast<std::size_t>(joint)].type == robot::JointType::prismatic;
    if (std::abs(now.robot.goal[i] - now.robot.q[i]) > (slides ? near_slide : near_turn))
      return false;
  }
  return true;
}

}  // namespace

robot::KinematicModel kinematics_of(const Snapshot& now) {
  if (!now.robot.present || !now.assets || !now.assets->robot)
    throw UsageError("the scene has no robot");
  return robot::KinematicModel(*now.assets->robot, now.assets->scene.robot->base);
}

const Eigen::VectorXd& start_of(const RobotSnapshot& robot) {
  return robot.follows_program ? robot.q : robot.goal;
}

Pose tool_at(const Snapshot& now, const robot::KinematicModel& model, const Eigen::VectorXd& q) {
  const Pose link = model.link_pose(q, now.robot.tool_link);
  return {link * now.assets->scene.robot->tool_offset, link.rotation};
}

int tool_freedom(const Snapshot& now, const robot::KinematicModel& model) {
  int count = 0;
  for (int i = 0; i < model.dofs(); ++i)
    count += model.moves(i, now.robot.tool_link) && !is_gripper(now, model, i);
  return count;
}

std::optional<RobotGhost> robot_ghost(const Snapshot& now) {
  if (!now.robot.present || !now.assets || !now.assets->robot || now.robot.loops) return {};
  const robot::KinematicModel model = kinematics_of(now);
  if (now.robot.goal.size() != model.dofs() || now.robot.q.size() != model.dofs() ||
      is_there(now, model))
    return {};
  RobotGhost ghost;
  model.link_poses(now.robot.goal, ghost.links);
  ghost.tool = tool_at(now, model, now.robot.goal);
  return ghost;
}

}  // namespace pedicel::app
