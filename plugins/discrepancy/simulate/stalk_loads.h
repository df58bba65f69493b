#pragma once

#include <limits>
#include <string>
#include <vector>

#include "plugins/cosserat/solver/detachment.h"

namespace pedicel::discrepancy {

using cosserat::stalk_limits;
using cosserat::StalkLoad;
using cosserat::StalkNumbers;
using enum cosserat::StalkLoad;
inline constexpr int stalk_load_count = static_cast<int>(stalk_limits.size());

/// What the joint under a fruit carried in a trial, until the fruit came off.
struct StalkLoads {
  std::string trial, fruit;
  std::vector<double> time;                                   ///< s, of each step, 0 first
  std::vector<StalkNumbers> load;                             ///< likewise
  double came_off = std::numeric_limits<double>::infinity();  ///< s; infinite: it stayed on
};

}  // namespace pedicel::discrepancy
