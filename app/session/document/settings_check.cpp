#include "app/session/document/settings_check.h"

#include "engine/core/check.h"
#include "plugins/simulation/plants/plant_overrides.h"
#include "plugins/simulation/plants/rod_options.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

void check_settings(const Document& document) {
  const world::Scene scene = scene_of(document);
  Diagnostics diagnostics;
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
  simulation::apply_rod_settings(scene.rods, rods, diagnostics);
  simulation::apply_coupling_settings(scene.coupling, coupling, diagnostics);
  for (std::size_t p = 0; p < document.plants.size(); ++p) {
    plant::PlantFile plant;
    if (document.plants[p].file) plant = *document.plants[p].file;
    simulation::apply_plant_overrides(plant, scene.plants[p].set, diagnostics);
  }
  if (diagnostics.has_errors()) throw UsageError(sentences(diagnostics.all()));
}

}  // namespace pedicel::app
