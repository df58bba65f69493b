#pragma once

#include "core/diagnostics.h"
#include "plant/plant_builder.h"

namespace pedicel::plant {

/// Changes a finished model as the plant's `effects:` say: those that are plain changes of the
/// model's constants (EffectKind::simulated). The rest shape stays that of the plant without
/// effects. An effect that cannot be simulated yet is an error, never passed over.
void apply_effects(const PlantFile& plant, BuiltPlant& built, Diagnostics& diagnostics);

}  // namespace pedicel::plant
