#pragma once

#include <optional>

#include "engine/robot/inverse_kinematics.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// Joint positions that bring the scene's tool to a place (m, W), with an orientation where one is
/// given; from `start` (rad or m) as a hand would lead it, else by another branch of the arm. The
/// gripper's joint stays. Throws UsageError where there is no robot; what cannot be reached is said
/// in the result.
robot::IkResult reach_tool(const simulation::Simulation& simulation, const Vec3& position_W,
                           const std::optional<Quat>& orientation_W, const Eigen::VectorXd& start);

/// The robot of a simulation. Throws UsageError where it has none.
const simulation::RobotControl& robot_of(const simulation::Simulation& simulation);

}  // namespace pedicel::app
