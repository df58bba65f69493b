#include <algorithm>

#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_detachment_threshold() {
  SceneEffectDefinition d;
  d.name = "detachment_threshold";
  d.plain_name = "stalks that hold more or less";
  d.sentence = "fruits come off at a multiple of the thresholds of the file";
  d.home = SceneHome::plant;
  d.parameters = {factor_of("factor", "on every threshold of the file"), which("plant", "plant")};
  d.apply = [](const SceneEffectTarget& t) {
    t.each_plant([&](SceneState::Plant& plant) { plant.threshold *= t.number("factor"); });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    // One that is grasped and stays on says something, too.
    const bool recorded = std::ranges::any_of(c.experiment.trials, [](const Trial& trial) {
      return std::ranges::any_of(trial.events, [](const MeasuredEvent& e) {
        return e.event == "detached" || e.event == "grasped";
      });
    });
    const bool fruits = std::ranges::any_of(
        c.experiment.plants, [](const ExperimentPlant& p) { return !p.file.fruits.empty(); });
    if (!recorded || !fruits) return {};
    std::vector<effects::Start> starts;
    // Where nothing comes off in the model, or everything at once, it has no slope.
    for (const double factor : {0.4, 0.6, 0.8, 1.25, 1.6, 2.5})
      starts.push_back(
          effects::Start("detachment_threshold").positive("factor", factor, 0.1, 10.0));
    return starts;
  };
  d.speaks_for = {{"detachment", 1}, {"force_breaks_off", 1}};
  // The force in a stalk is known as its stiffness is, and with it the moment at which it parts. On
  // meshes of 10 and of 5 mm the fruit of a stalk of 60 mm came off 2 ms apart, and two solvers 7.
  d.factor_known_to = 0.02;
  d.tells_apart = "pull a fruit with a force gauge until it comes off";
  return d;
}

}  // namespace pedicel::discrepancy
