#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

/// From where fits of effects of the plants' own models start, in the order of their definitions:
/// of plants that were seen or that the arm comes near, and at places of such curves alone.
/// `beside`: effects that the model has already; what cannot be simulated with them is left out.
std::vector<SceneFit> plant_starts(const Experiment& experiment,
                                   const std::vector<plant::Effect>& beside);

}  // namespace pedicel::discrepancy
