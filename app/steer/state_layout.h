#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/steer/state_fields.h"
#include "plugins/simulation/plants/organ_places.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// What the rows of a state are: the same as long as a scene is the same.
struct StateLayout {
  explicit StateLayout(const simulation::Simulation& simulation);
  bool operator==(const StateLayout&) const = default;

  int rows(Rows kind) const { return static_cast<int>(names[static_cast<int>(kind)].size()); }
  const std::vector<std::string>& of(Rows kind) const { return names[static_cast<int>(kind)]; }

  std::array<std::vector<std::string>, row_kinds> names;
  std::vector<int> segment_organ;   ///< index of an organ, by segment
  std::vector<int> segment_parent;  ///< segment that it starts from, by segment; -1: clamped
  std::vector<int> first_segment;   ///< by plant, and the number of all segments behind them
  std::vector<int> first_fruit;     ///< likewise
  std::vector<int> first_organ;     ///< likewise
  std::vector<int> touching_of;     ///< row of Rows::touching, by collider of the scene's start
};

}  // namespace pedicel::app
