#pragma once

#include "plugins/cosserat/model/rod_model.h"
#include "plugins/discrepancy/scene/scene_state.h"

/// From the numbers of a scene's state to the things that have them. A diagnosis and a run of the
/// scene go the same way.
namespace pedicel::discrepancy {

/// The robot with its tool (index of a link) where it is, and the payload in it.
robot::RobotDescription with_tool(robot::RobotDescription robot, int tool, const SceneState& state);

/// The robot with the joints' friction.
robot::RobotDescription with_friction(robot::RobotDescription robot, const SceneState& state);

/// The robot whose links stand at reading plus offset: its joints still say what encoders read.
robot::RobotDescription with_joint_offsets(robot::RobotDescription robot, const SceneState& state);

/// Masses of fruits and thresholds of stalks of a built plant. Its rest shape stays.
void change_plant(cosserat::RodModel& model, const SceneState::Plant& state);

/// Where the plant stands in place of where it was built: turned about the vertical through its
/// root, `root_W`, and moved.
Pose moved_plant(const Vec3& root_W, const SceneState::Plant& state);

}  // namespace pedicel::discrepancy
