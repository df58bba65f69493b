#pragma once

#include <cstdint>
#include <string>

namespace pedicel::stress {

/// What came of plants that stand in each other, some with leaf blades, are pulled, rammed, tied to
/// posts and to each other, and cut, all of it drawn from a seed.
struct CanopyOutcome {
  std::string fault;        ///< empty: none
  std::string description;  ///< what was drawn, one line
  std::uint64_t hash = 0;   ///< of the plants' states at the end
  long contacts = 0;        ///< sides of contacts between plants, summed over the steps
  double imbalance = 0.0;   ///< N, largest sum of all forces that plants exert on each other
};

/// Runs the ordeal of a seed. A fault is a number that is not finite, an element faster than
/// anything that was drawn could make it, energy that nothing put in, or forces that do not
/// balance.
CanopyOutcome run_canopy(std::uint64_t seed, int threads);

}  // namespace pedicel::stress
