#pragma once

#include <string>
#include <vector>

#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::simulation {

/// A place on a plant.
struct PlaceOnPlant {
  int plant = 0, element = 0;
  double back = 0.0;  ///< m, from the element's far node
};

/// Of "PLANT/FRUIT" (its centre), or of "PLANT/STEM" at a fraction of its length from its foot.
/// Throws UsageError with the names that there are.
PlaceOnPlant find_organ_place(const cosserat::RodSystem& rods, const std::string& organ, double at);

/// "one, two, three, ...": for sentences that say what was expected.
std::string list_of(const std::vector<std::string>& names);

}  // namespace pedicel::simulation
