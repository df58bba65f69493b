#include "pedicel/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_plant_pose() {
  SceneEffectDefinition d;
  d.name = "plant_pose";
  d.plain_name = "a plant that stands elsewhere";
  d.sentence = "the plant stands elsewhere in the frame of the robot";
  d.parameters = {
      {.name = "offset",
       .unit = "m",
       .bounds = io::any_number,
       .sentence = "by how much its root is displaced",
       .size = 3,
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0, 0.0, 0.0}},
      {.name = "yaw",
       .unit = "rad",
       .bounds = io::any_number,
       .sentence = "about the vertical through its root",
       .required = false,
       .otherwise = "0",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
      {.name = "plant",
       .sentence = "which plant",
       .size = 0,
       .required = false,
       .otherwise = "all"},
  };
  d.apply = [](const SceneEffectTarget& t) {
    t.each_plant([&](SceneState::Plant& plant) {
      plant.offset += t.vector("offset");
      if (t.has("yaw")) plant.yaw += t.number("yaw");
    });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const ScenePlantFile& plant : c.experiment.plants) {
      effects::Start start("plant_pose");
      if (c.experiment.plants.size() > 1) start.word("plant", plant.name);
      start.vector("offset", Vec3::Zero(), 1.0e-3, 0.1).signed_number("yaw", 0.0, 0.01, -0.5, 0.5);
      starts.push_back(start);
    }
    return starts;
  };
  d.tells_apart = "measure where the plant's root is in the frame of the robot";
  return d;
}

}  // namespace pedicel::discrepancy
