#pragma once

#include <functional>

#include "engine/robot/robot.h"
#include "engine/world/sim_world.h"

namespace pedicel::simulation {

/// What rigid bodies and the ground exerted on the robot's links in the step that has ended: calls
/// `take` with each contact's link, force (N, W, on the link) and place (m, W). Contacts of the
/// robot with itself are left out.
void each_body_contact(
    world::SimWorld& world, robot::Robot& robot,
    const std::function<void(int link, const Vec3& force_W, const Vec3& place_W)>& take);

}  // namespace pedicel::simulation
