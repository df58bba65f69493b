#pragma once

#include "tests/discrepancy/scene_cases/scene_case.h"

/// A harvest: the finger reaches past a stem, takes the fruit of its truss, pushes the stem aside
/// with its shaft, and pulls until the stalk parts.
namespace pedicel::scene_case {

/// Gives a setting its truss, and a stem that bears it. Sizes are drawn from its seed.
void make_harvest(Setting& setting);

/// The arm's ways in a harvest, at most three: the first and the third are for fits, the second is
/// held out, as another way to pull.
std::vector<Drive> harvest_drives(const Setting& setting);

}  // namespace pedicel::scene_case
