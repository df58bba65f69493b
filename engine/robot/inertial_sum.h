#pragma once

#include "engine/robot/description.h"

namespace pedicel::robot {

/// Adds a body, given in a frame at `pose`, to a sum of bodies (parallel axis theorem).
void add_inertial(Inertial& sum, const Inertial& part, const Pose& pose);

}  // namespace pedicel::robot
