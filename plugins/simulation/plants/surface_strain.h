#pragma once

#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::simulation {

/// How far an element is strained at its surface, from its unloaded rest shape: stretch and shear,
/// plus radius times curvature (1).
double surface_strain(const cosserat::RodModel& model, const cosserat::RodState& state,
                      int element);

}  // namespace pedicel::simulation
