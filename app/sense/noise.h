#pragma once

#include <cstdint>
#include <string_view>

#include "app/sense/sensed_picture.h"
#include "engine/core/random.h"
#include "engine/world/sensors.h"

namespace pedicel::app {

/// Another seed for each sensor and each of its samples: the same for the same run's seed.
std::uint64_t noise_seed(std::uint64_t run_seed, std::string_view sensor, std::uint64_t sample);

/// Puts a camera's noise on a picture. Where a depth is lost it is not a number. Labels and
/// keypoints stay as they are. Draws nothing where the noise is zero.
void add_noise(SensedPicture& picture, const world::CameraNoise& noise, Random random);

}  // namespace pedicel::app
