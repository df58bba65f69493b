#pragma once

#include <vector>

#include "pedicel/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

/// Effects of plants' own models as causes of a scene, with values to begin fits from: those that
/// change how stiff or heavy a plant is, or parts of it. Laws of damping, memory, thresholds and
/// air are not among them: a robot's push shows little of these, and a plant's own experiment shows
/// them. Where there are several plants each start says which one it is of. What has a place is
/// looked for on the six longest curves of a plant.
std::vector<SceneFit> plant_causes(const SceneExperiment& experiment);

}  // namespace pedicel::discrepancy
