#pragma once

#include "core/diagnostics.h"
#include "plant/plant_builder.h"

namespace pedicel::plant {

/// The effects that are laws of joints and air rather than constants: material_nonlinearity,
/// structural_damping, internal_friction, relaxation, creep, yield, stiffness_drift, wind, gust,
/// leaf_drag. Joints and segments of the curves have them (of one curve, with `where`), leaves do
/// not; drift concerns the whole plant.
bool is_law(const std::string& effect);

/// Adds one of them to a model whose constants are final. Faults go to `diagnostics`.
void apply_law(const PlantFile& plant, const Effect& effect, BuiltPlant& built,
               Diagnostics& diagnostics);

/// Once all are added: what is elastic yields where the plant says so, and what does not go
/// together is reported.
void finish_laws(const PlantFile& plant, BuiltPlant& built, Diagnostics& diagnostics);

}  // namespace pedicel::plant
