#include "plugins/discrepancy/scene/arm.h"

#include "plugins/discrepancy/scene/state_changes.h"

namespace pedicel::discrepancy {

namespace {

robot::RobotDescription changed(const Experiment& experiment, const SceneState& state) {
  if (!experiment.scene.robot) return experiment.robot;
  return with_tool(experiment.robot, tool_link(*experiment.scene.robot, experiment.robot), state);
}

}  // namespace

int tool_link(const world::SceneRobot& scene, const robot::RobotDescription& robot) {
  const int named = robot.link(scene.tool.empty() ? "tool" : scene.tool);
  return named >= 0 ? named : static_cast<int>(robot.links.size()) - 1;
}

Arm::Arm(const Experiment& experiment, const SceneState& state)
    : description_(changed(experiment, state)),
      model_(description_, experiment.scene.robot ? experiment.scene.robot->base : Pose{}) {
  tool_ = experiment.scene.robot ? tool_link(*experiment.scene.robot, description_) : 0;
  start_ = model_.neutral();
  if (experiment.scene.robot)
    for (const auto& [joint, value] : experiment.scene.robot->joints)
      if (const int dof = model_.joint_index(joint); dof >= 0) start_[dof] = value;
}

}  // namespace pedicel::discrepancy
