#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace pedicel::discrepancy {

/// What can break a stalk; the first two are strains from the unloaded shape.
enum StalkLoad { stalk_stretch, stalk_bend, stalk_force, stalk_moment, stalk_torsion };
inline constexpr int stalk_load_count = 5;
using StalkNumbers = std::array<double, stalk_load_count>;  ///< 1, rad, N, N m, N m

/// What the joint under a fruit carried in a trial, until the fruit came off.
struct StalkLoads {
  std::string trial, fruit;
  std::vector<double> time;                                   ///< s, of each step, 0 first
  std::vector<StalkNumbers> load;                             ///< likewise
  double came_off = std::numeric_limits<double>::infinity();  ///< s; infinite: it stayed on
};

}  // namespace pedicel::discrepancy
