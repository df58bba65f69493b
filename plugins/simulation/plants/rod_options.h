#pragma once

#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/world/scene.h"
#include "plugins/cosserat/solver/rod_solver.h"
#include "plugins/coupling/coupling_settings.h"

namespace pedicel::simulation {

/// Applies what a scene's section `rods`, or `--set rods.KEY=VALUE`, says: the parameters of
/// RodSettings and the words `solver` and `integrator`. Faults go to `diagnostics`.
void apply_rod_settings(const std::vector<world::Setting>& settings, cosserat::RodSettings& rods,
                        Diagnostics& diagnostics);

/// The section `coupling:` of a scene to settings of the contacts.
void apply_coupling_settings(const std::vector<world::Setting>& settings,
                             coupling::CouplingSettings& coupling, Diagnostics& diagnostics);

}  // namespace pedicel::simulation
