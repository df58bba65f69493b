#pragma once

#include <string_view>

#include "pedicel/io/yaml.h"

namespace pedicel::plant {

/// What a number of a plant may be, wherever it comes from (its file, `--set`, the window):
/// material.youngs_modulus (Pa), .poisson_ratio (1), .density (kg/m3), .damping_time (s);
/// detach.stretch (1), .bend (rad), .force (N), .moment, .torsion (N m); sampling.connect,
/// .distance (m). Asserts that there is such a key.
io::Bounds number_bounds(std::string_view key);

}  // namespace pedicel::plant
