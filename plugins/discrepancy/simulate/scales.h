#pragma once

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/effects/registry/effect_start.h"

namespace pedicel::discrepancy {

using effects::Scales;

/// Rough sizes of an experiment, from which candidates take their first values.
Scales scales_of(const Experiment& experiment);

}  // namespace pedicel::discrepancy
