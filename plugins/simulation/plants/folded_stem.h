#pragma once

#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::simulation {

/// An element that lies flat on the one that it grows from, -1 where none does. A joint's energy
/// has a ridge at half a turn: its moment changes its sign there, so that no equilibrium is found
/// on it, and what is beyond is another shape than a stem could come to.
inline int folded_element(const cosserat::RodModel& model, const cosserat::RodState& state) {
  constexpr double half_turn = 3.1;  // rad
  for (int e = 0; e < state.size(); ++e) {
    const cosserat::Element& element = model.elements[e];
    if (!state.alive[e] || element.parent < 0) continue;
    const Quat rest = state.orientation[element.parent] * element.rest_rotation;
    if (rest.angularDistance(state.orientation[e]) > half_turn) return e;
  }
  return -1;
}

inline constexpr const char* folded_text =
    "folded flat, by half a turn between two of its elements, where a rod has no equilibrium: "
    "expected a limit that breaks it before (detach.bend), a smaller sampling.distance, or a grip "
    "in which it can turn (less friction)";

}  // namespace pedicel::simulation
