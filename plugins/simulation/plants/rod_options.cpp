#include "plugins/simulation/plants/rod_options.h"

#include "engine/world/settings.h"

namespace pedicel::simulation {

void apply_rod_settings(const std::vector<world::Setting>& settings, cosserat::RodSettings& rods,
                        Diagnostics& diagnostics) {
  int solver = static_cast<int>(rods.solver);
  int integrator = static_cast<int>(rods.integrator);
  world::apply_settings(settings, "rods", cosserat::parameters_of(rods),
                        {{"solver", {"direct", "position_based"}, &solver},
                         {"integrator", {"backward_euler", "bdf2"}, &integrator}},
                        diagnostics);
  rods.solver = static_cast<cosserat::SolverKind>(solver);
  rods.integrator = static_cast<cosserat::Integrator>(integrator);
}

void apply_coupling_settings(const std::vector<world::Setting>& settings,
                             coupling::CouplingSettings& coupling, Diagnostics& diagnostics) {
  int direction = coupling.two_way ? 1 : 0;
  world::apply_settings(settings, "coupling", coupling::parameters_of(coupling),
                        {{"direction", {"one_way", "two_way"}, &direction}}, diagnostics);
  coupling.two_way = coupling.two_way || direction == 1;
}

}  // namespace pedicel::simulation
