#include "app/session/live/instability.h"

#include "engine/io/csv.h"

namespace pedicel::app {

Instability instability_of(const simulation::Simulation& simulation, double last_good_time) {
  const world::WorldReport& report = simulation.world().report();
  Instability found;
  found.last_good_time = last_good_time;
  found.culprit = report.culprit;
  const cosserat::RodSystem& rods = simulation.rods();
  for (int p = 0; p < rods.size() && found.plant < 0; ++p) {
    const cosserat::StepReport& own = rods.report(p);
    if (own.errors == 0 || own.element < 0) continue;
    found.plant = p;
    found.element = own.element;
    const cosserat::RodModel& model = rods.model(p);
    if (found.culprit.empty()) found.culprit = model.organs[model.elements[own.element].organ];
  }
  found.error = "unstable at " + io::format_number(report.time, 6) +
                " s: " + (found.culprit.empty() ? "" : found.culprit + ": ") +
                world::remedy(static_cast<world::WorldError>(report.errors & world::fatal_errors));
  return found;
}

}  // namespace pedicel::app
