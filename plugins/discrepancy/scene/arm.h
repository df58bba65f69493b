#pragma once

#include <memory>
#include <vector>

#include "engine/robot/kinematics.h"
#include "plugins/coupling/collider.h"
#include "plugins/discrepancy/scene/scene_state.h"
#include "plugins/discrepancy/scene/smooth_readings.h"

namespace pedicel::discrepancy {

/// A robot's arm as a variant of the scene has it: where its links are at joint positions, and what
/// they weigh. Joints that no table has stand where the scene starts them.
class Arm {
 public:
  Arm(const SceneExperiment& experiment, const SceneState& state);

  const robot::KinematicModel& model() const { return model_; }
  /// With the payload in its tool.
  const robot::RobotDescription& description() const { return description_; }
  const Eigen::VectorXd& start() const { return start_; }
  int tool() const { return tool_; }
  /// Links that move with a link: itself and all beyond it.
  const std::vector<int>& beyond(int link) const { return beyond_[static_cast<std::size_t>(link)]; }

  /// N and N m in the link's frame, about its origin: weight and inertia of the link and all
  /// beyond it, as they pull at what carries it, at poses of the model at q.
  Eigen::Matrix<double, 6, 1> own_wrench(int link, const JointPath::Point& motion,
                                         const Vec3& gravity) const;
  /// The same as the mean of a step of `dt` (s) in which momentum changes from one motion to the
  /// other, in the frame at its end: as a run makes it.
  Eigen::Matrix<double, 6, 1> own_wrench(int link, const JointPath::Point& begin,
                                         const JointPath::Point& end, double dt,
                                         const Vec3& gravity) const;

 private:
  robot::RobotDescription description_;
  robot::KinematicModel model_;
  std::vector<std::vector<int>> beyond_;
  Eigen::VectorXd start_;
  int tool_ = 0;
};

/// The link that the scene calls the tool, else one called "tool", else the last.
int tool_link(const world::SceneRobot& scene, const robot::RobotDescription& robot);

}  // namespace pedicel::discrepancy
