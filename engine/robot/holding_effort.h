#pragma once

#include <optional>
#include <string>

#include "engine/robot/dynamics.h"

namespace pedicel::robot {

/// What is said of a robot whose motors cannot hold it at rest at q (rad or m) under gravity
/// (m/s2): the joint that lacks most, what it needs and has (N m or N), and how many more lack
/// something. A joint's friction counts as help. Nothing where all of them can.
std::optional<std::string> too_weak_to_hold(const RobotDescription& robot,
                                            const KinematicModel& model, const Eigen::VectorXd& q,
                                            const Vec3& gravity_W);

}  // namespace pedicel::robot
