#pragma once

#include "engine/core/diagnostics.h"
#include "engine/world/scene.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::simulation {

/// Changes a plant as a scene's `set:` or `--set` says (see build_plants() for the keys). A
/// material number is the plant's own: curves that have one of theirs keep their ratio to it, so
/// that the number which the plant has already changes nothing. Where the plant has none, all
/// curves get it. Unknown keys and impossible values go to `diagnostics`.
void apply_plant_overrides(plant::PlantFile& plant, const std::vector<world::Setting>& settings,
                           Diagnostics& diagnostics);

}  // namespace pedicel::simulation
