#pragma once

#include <span>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/effects/registry/effect_start.h"
#include "plugins/plant/plant_builder.h"

namespace pedicel::discrepancy {

using effects::Scales;

/// What a trial says of a plant's scales.
struct TrialScales {
  const Samples& markers;  ///< m, of places of that plant alone
  double duration = 0.0;   ///< s
  bool is_static = false;
};

/// Rough sizes of a plant and of how it moved, from which candidates take their first values.
Scales scales_of(const plant::BuiltPlant& built, std::span<const TrialScales> trials);

/// The same of an experiment. Throws InvalidFile where its plant cannot be built.
Scales scales_of(const Experiment& experiment);

}  // namespace pedicel::discrepancy
