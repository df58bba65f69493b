#include "plugins/simulation/scene_assets.h"

#include "engine/world/settings.h"
#include "plugins/discrepancy/scene/arm.h"
#include "plugins/discrepancy/scene/state_changes.h"
#include "plugins/simulation/plants/rod_options.h"
#include "plugins/simulation/plants/wind_field.h"
#include "plugins/simulation/robot_control.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::simulation {

namespace {

void read_settings(SceneAssets& assets, Diagnostics& diagnostics) {
  apply_rod_settings(assets.scene.rods, assets.rods, diagnostics);
  apply_coupling_settings(assets.scene.coupling, assets.coupling, diagnostics);
}

}  // namespace

void SceneAssets::read_effects(Diagnostics& diagnostics) {
  if (scene.robot && !robot) return;
  effects = discrepancy::read_run_effects(scene, robot ? &*robot : nullptr, coupling, diagnostics);
  coupling = effects->state.coupling;
  notes.insert(notes.end(), effects->notes.begin(), effects->notes.end());
  if (!robot || diagnostics.has_errors()) return;
  believed = robot;
  const discrepancy::SceneState& state = effects->state;
  *robot = discrepancy::with_tool(std::move(*robot),
                                  discrepancy::tool_link(*scene.robot, *believed), state);
  *robot = discrepancy::with_friction(std::move(*robot), state);
  *robot = discrepancy::with_joint_offsets(std::move(*robot), state);
}

SceneAssets::SceneAssets(const world::Scene& given, const SimulationOptions& options)
    : scene(given.vary.empty() ? given : world::drawn_scene(given)) {
  Diagnostics diagnostics, of_robot;
  read_settings(*this, diagnostics);
  // Effects name its joints, and plants need effects.
  if (scene.robot) robot = read_robot(*scene.robot, options.packages, of_robot);
  if (!scene.effects.empty()) read_effects(diagnostics);
  const discrepancy::RunEffects* changes = effects ? &*effects : nullptr;
  for (ScenePlantModel& plant : build_plants(scene, options, changes, diagnostics, notes)) {
    if (scene.wind) expose_to_wind(plant.model, plant.info.blades);
    models.push_back(std::move(plant.model));
    plants.push_back(std::move(plant.info));
  }
  // Goes on after faults in plants, so that all faults are told at once.
  if (!of_robot.all().empty()) diagnostics.add(InvalidFile(of_robot));
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  // Grids take seconds, and only plants ask for them in every step.
  if (robot) robot_fields = models.empty() ? exact_fields_of(*robot) : fields_of(*robot, notes);
  for (const Diagnostic& warning : diagnostics.all()) notes.push_back(to_string(warning));
}

}  // namespace pedicel::simulation
