#pragma once

#include "core/diagnostics.h"
#include "plant/plant_builder.h"

namespace pedicel::plant {

/// Changes a finished model as the plant's `effects:` say. Anisotropy, which turns frames, goes
/// first; then the other changes of constants in the list's order; then the laws of joints and air,
/// which refer to final constants (apply_laws.h). The rest shape stays that of the plant without
/// effects. What does not go together is an error, and so is an effect that cannot be simulated
/// (EffectKind::simulated): none is passed over.
void apply_effects(const PlantFile& plant, BuiltPlant& built, Diagnostics& diagnostics);

}  // namespace pedicel::plant
