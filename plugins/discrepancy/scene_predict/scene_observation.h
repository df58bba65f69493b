#pragma once

#include <span>

#include "plugins/discrepancy/scene_predict/trial_simulation.h"

namespace pedicel::discrepancy {

/// What the instruments of a trial would have reported, at their own times: rows and columns as the
/// trial's tables. Without noise.
struct SceneReadings {
  Eigen::MatrixXd markers;                ///< m, W
  std::vector<Eigen::MatrixXd> pixels;    ///< px, by camera
  std::vector<Eigen::MatrixXd> wrenches;  ///< N and N m, by sensor
  Eigen::MatrixXd torques;                ///< N m or N, of the motors
  Eigen::MatrixXd joints;  ///< rad or m, of encoders; only where the arm follows commands
  bool healthy = true;
  std::vector<MeasuredEvent> events;
};

/// Motion to readings. `effects`: those of the experiment's instruments that plants' experiments
/// have, too (latency, marker_offset, frame_rotation, marker_scale).
SceneReadings observe_scene(const Experiment& experiment, const Trial& trial,
                            const SceneMotion& motion, const SceneMember& member,
                            std::span<const plant::Effect> effects);

}  // namespace pedicel::discrepancy
