#pragma once

#include <vector>

#include "plugins/discrepancy/scene/arm.h"

namespace pedicel::discrepancy {

/// Where an arm's links go that follows commands: Bullet's arm with its motors, damping and
/// friction, alone in its world, from the first row on. It does not feel the plants. Steps of `dt`
/// (s), up to `until` (s).
JointPath run_arm(const Experiment& experiment, const Trial& trial, const SceneState& state,
                  const Arm& arm, double dt, double until);

/// The path through positions that have no noise, one row a time (s): from rest, with differences
/// as velocities.
JointPath path_through(std::vector<double> time, const std::vector<Eigen::VectorXd>& positions);

}  // namespace pedicel::discrepancy
