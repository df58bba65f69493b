#pragma once

#include <memory>

#include "engine/robot/kinematics.h"
#include "plugins/coupling/collider.h"
#include "plugins/discrepancy/scene/scene_state.h"
#include "plugins/discrepancy/scene/smooth_readings.h"

namespace pedicel::discrepancy {

/// A robot's arm as a variant of the scene has it: where its links are at joint positions, and what
/// they weigh. Joints that no table has stand where the scene starts them.
class Arm {
 public:
  Arm(const Experiment& experiment, const SceneState& state);

  const robot::KinematicModel& model() const { return model_; }
  /// With the payload in its tool.
  const robot::RobotDescription& description() const { return description_; }
  const Eigen::VectorXd& start() const { return start_; }
  int tool() const { return tool_; }

 private:
  robot::RobotDescription description_;
  robot::KinematicModel model_;
  Eigen::VectorXd start_;
  int tool_ = 0;
};

/// The link that the scene calls the tool, else one called "tool", else the last.
int tool_link(const world::SceneRobot& scene, const robot::RobotDescription& robot);

}  // namespace pedicel::discrepancy
