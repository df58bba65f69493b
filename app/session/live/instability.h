#pragma once

#include <string>

#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A run that can go no further: which organ has the worst error, and why.
struct Instability {
  std::string error;    ///< when, where and what helps, in words
  std::string culprit;  ///< an organ; may be empty
  int plant = -1, element = -1;
  double last_good_time = 0.0;  ///< s
};

/// Of a simulation whose last step has a fatal error.
Instability instability_of(const simulation::Simulation& simulation, double last_good_time);

}  // namespace pedicel::app
