#pragma once

#include <string>

#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// Share of a fruit's disc (1) that is seen from a place (m, W): 64 rays to it that no stem, leaf,
/// other fruit, link, body or ground is before. By geometry, so it needs no picture. Throws
/// UsageError where there is no such fruit.
double visible_share(const simulation::Simulation& simulation, const std::string& fruit,
                     const Vec3& eye_W);

/// Where a camera of the scene stands now, m, W. Throws UsageError where there is none of that
/// name.
Vec3 camera_place(const simulation::Simulation& simulation, const std::string& camera);

}  // namespace pedicel::app
