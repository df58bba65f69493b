#pragma once

#include <vector>

#include "pedicel/core/diagnostics.h"
#include "pedicel/cosserat/solver/rod_solver.h"
#include "pedicel/coupling/coupling_settings.h"
#include "pedicel/world/scene.h"

namespace pedicel::app {

/// Applies what a scene's section `rods`, or `--set rods.KEY=VALUE`, says: the parameters of
/// RodSettings and the words `solver` and `integrator`. Faults go to `diagnostics`.
void apply_rod_settings(const std::vector<world::Setting>& settings, cosserat::RodSettings& rods,
                        Diagnostics& diagnostics);

/// The section `coupling:` of a scene to settings of the contacts.
void apply_coupling_settings(const std::vector<world::Setting>& settings,
                             coupling::CouplingSettings& coupling, Diagnostics& diagnostics);

}  // namespace pedicel::app
