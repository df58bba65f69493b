#include <algorithm>

#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_fruit_mass() {
  SceneEffectDefinition d;
  d.name = "fruit_mass";
  d.plain_name = "fruits of another mass";
  d.sentence = "the fruits weigh a multiple of what the file says";
  d.home = SceneHome::plant;
  d.parameters = {factor_of("factor", "on the mass of every fruit"), which("plant", "plant")};
  d.apply = [](const SceneEffectTarget& t) {
    t.each_plant([&](SceneState::Plant& plant) { plant.fruit_mass *= t.number("factor"); });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    if (std::ranges::none_of(c.experiment.plants, [](const ExperimentPlant& plant) {
          return !plant.file.fruits.empty();
        }))
      return {};
    return {effects::Start("fruit_mass").positive("factor", 1.0, 0.1, 10.0)};
  };
  d.tells_apart = "weigh a fruit";
  return d;
}

}  // namespace pedicel::discrepancy
