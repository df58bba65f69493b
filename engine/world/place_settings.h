#pragma once

#include <string>

#include "engine/world/scene.h"

namespace pedicel::world {

/// Keys of `--set` that say where something stands and how it is seen:
///   plants.NAME.position.x (y, z; m), plants.NAME.yaw (rad, about Z)
///   bodies.NAME.position.x, bodies.NAME.yaw, robot.position.x, robot.yaw
///   cameras.NAME.eye.x, cameras.NAME.target.x (m), cameras.NAME.fov (rad)
///   cameras.NAME.noise.KEY, wrenches.NAME.noise.KEY and the like: a number of a sensor's noise
///   loads.angle, loads.azimuth (rad): where every load pulls, from straight down, and about Z
///   look.KEY (SceneLook)
/// False where the key is none of these. Throws UsageError where the value is impossible, or there
/// is no such thing.
bool set_place(Scene& scene, const std::string& key, const std::string& text,
               const std::string& asked);

/// What such keys look like, for "expected ..." sentences.
std::string place_keys();

}  // namespace pedicel::world
