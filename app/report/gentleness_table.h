#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// How one organ or fruit was handled, by its name.
struct HandledOrgan {
  std::string name;  ///< "truss/fruit_3"
  bool fruit = false;
  simulation::Gentleness::Record record;
};

/// Organs and fruits that were touched, broken, or whose stalk bore anything, in the order of their
/// plants.
std::vector<HandledOrgan> handled_organs(const simulation::Simulation& simulation);

/// Columns organ, touched_at_s, peak_force_N, impulse_N_s, margin_used_1, strain_energy_J, broken.
std::string to_csv(const std::vector<HandledOrgan>& organs);

nlohmann::ordered_json to_json(const simulation::Gentleness::Total& total,
                               const std::vector<HandledOrgan>& organs);

}  // namespace pedicel::app
