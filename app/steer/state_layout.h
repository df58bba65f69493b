#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "pedicel/app/run/simulation.h"
#include "pedicel/app/steer/state_fields.h"

namespace pedicel::app {

/// What the rows of a state are: the same as long as a scene is the same.
struct StateLayout {
  explicit StateLayout(const Simulation& simulation);
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

/// A place on a plant.
struct OrganPlace {
  int plant = 0, element = 0;
  double back = 0.0;  ///< m, from the element's far node
};

/// Of "PLANT/FRUIT" (its centre), or of "PLANT/STEM" at a fraction of its length from its foot.
/// Throws UsageError with the names that there are.
OrganPlace find_organ_place(const Simulation& simulation, const std::string& organ, double at);

/// "one, two, three, ...": for sentences that say what was expected.
std::string list_of(const std::vector<std::string>& names);

}  // namespace pedicel::app
