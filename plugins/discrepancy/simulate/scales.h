#pragma once

#include "pedicel/discrepancy/data/experiment.h"
#include "pedicel/effects/registry/effect_start.h"

namespace pedicel::discrepancy {

using effects::Scales;

/// Rough sizes of an experiment, from which candidates take their first values.
Scales scales_of(const Experiment& experiment);

}  // namespace pedicel::discrepancy
