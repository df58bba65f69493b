#include "pedicel/app/run/scene_assets.h"

#include "pedicel/app/plants/rod_options.h"
#include "pedicel/app/plants/wind_field.h"
#include "pedicel/app/run/scene_plants.h"
#include "pedicel/world/settings.h"

namespace pedicel::app {

namespace {

void read_settings(SceneAssets& assets, Diagnostics& diagnostics) {
  apply_rod_settings(assets.scene.rods, assets.rods, diagnostics);
  apply_coupling_settings(assets.scene.coupling, assets.coupling, diagnostics);
}

}  // namespace

SceneAssets::SceneAssets(const world::Scene& given, const SimulationOptions& options)
    : scene(given.vary.empty() ? given : world::drawn_scene(given)) {
  Diagnostics diagnostics;
  read_settings(*this, diagnostics);
  for (ScenePlantModel& plant : build_plants(scene, options, diagnostics, notes)) {
    if (scene.wind) expose_to_wind(plant.model, plant.info.blades);
    models.push_back(std::move(plant.model));
    plants.push_back(std::move(plant.info));
  }
  // Goes on after faults in plants, so that all faults are told at once.
  if (scene.robot) robot = read_robot(*scene.robot, options.packages, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  // Grids take seconds, and only plants ask for them in every step.
  if (robot) robot_fields = models.empty() ? exact_fields_of(*robot) : fields_of(*robot, notes);
  for (const Diagnostic& warning : diagnostics.all()) notes.push_back(to_string(warning));
}

}  // namespace pedicel::app
