#pragma once

#include <optional>
#include <string>

#include "engine/robot/kinematics.h"

namespace pedicel::robot {

/// What is wrong with a value (rad or m) of a degree of freedom that lies more than `slack` outside
/// of its limits: the value, the range, and "degrees?" or "millimetres?" where that many of them
/// lie within. Nothing where the value is in the range.
std::optional<std::string> outside_range(const KinematicModel& model, int dof, double value,
                                         double slack = 0.0);

/// A doubt about a start value (rad) of a joint without limits: many turns, which may be degrees.
std::optional<std::string> many_turns(const KinematicModel& model, int dof, double value);

}  // namespace pedicel::robot
