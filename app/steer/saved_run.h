#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/steer/act.h"

namespace pedicel::app {

/// How a run comes to where it is: Bullet keeps history in many places and hands none of it out, so
/// what is kept is everything that was done, and the hash that proves the result.
struct SavedRun {
  std::uint64_t model = 0;  ///< model_hash() of the scene as it was built
  long steps = 0;
  std::uint64_t state = 0;  ///< Simulation::state_hash()
  std::vector<Act> acts;    ///< in the order in which they were done
};

/// As bytes that can be written to a file, and back. Throws UsageError where they are none.
std::string to_text(const SavedRun& saved);
SavedRun saved_run_of_text(const std::string& text);

}  // namespace pedicel::app
