#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

namespace {

// Of an upright thing the yaw about its root is not seen, and its prior keeps it.
SceneFit unseen_place(const SceneStartContext& context, const ExperimentPlant& plant) {
  constexpr double way = 2.0e-3, turn = 0.02;  // m, rad: of a unit step
  effects::Start start("plant_pose");
  if (context.experiment.plants.size() > 1) start.word("plant", plant.name);
  start.vector("offset", Vec3::Zero(), way, 0.15).signed_number("yaw", 0.0, turn, -1.0, 1.0);
  SceneFit fit{start.effect(), start.free()};
  for (effects::FreeParameter& free : fit.free)
    free.prior = free.name == "yaw" ? context.settings.fit.yaw_known_to / turn
                                    : context.settings.fit.place_known_to / way;
  return fit;
}

InBaseline where_nothing_shows_it() {
  InBaseline own;
  own.fits = [](const SceneStartContext& c) {
    std::vector<SceneFit> fits;
    for (std::size_t p = 0; p < c.experiment.plants.size(); ++p)
      if (!is_seen(c.experiment, static_cast<int>(p)))
        fits.push_back(unseen_place(c, c.experiment.plants[p]));
    return fits;
  };
  own.parameter = "offset";
  // Horizontally: when a tool touches, or whether, decides. Upwards a stem goes on.
  own.without_slope = 2;
  own.because =
      "nothing shows where the plant stands but what it does to the arm, and that puts it there";
  own.told = [](const Experiment& experiment, const plant::Effect& effect, int component) {
    const auto named = effect.words.find("plant");
    const int at = named == effect.words.end() ? 0 : experiment.plant_index(named->second);
    const ExperimentPlant& plant = experiment.plants[static_cast<std::size_t>(at)];
    // Where its root is, since that is what a ruler finds.
    return InBaseline::Told{plant.name + "_root_" + "xyz"[component],
                            (plant.pose * plant.file.root)[component]};
  };
  return own;
}

}  // namespace

SceneEffectDefinition define_plant_pose() {
  SceneEffectDefinition d;
  d.name = "plant_pose";
  d.plain_name = "a plant that stands elsewhere";
  d.sentence = "the plant stands elsewhere in the frame of the robot";
  d.home = SceneHome::plant;
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
    for (const ExperimentPlant& plant : c.experiment.plants) {
      effects::Start start("plant_pose");
      if (c.experiment.plants.size() > 1) start.word("plant", plant.name);
      constexpr double turn = 0.01;  // rad, of a unit step
      start.vector("offset", Vec3::Zero(), 1.0e-3, 0.1).signed_number("yaw", 0.0, turn, -0.5, 0.5);
      // A straight stem hardly shows its yaw, and without a prior it runs away to a bound.
      start.prior(c.settings.fit.yaw_known_to / turn, 0.0);
      starts.push_back(start);
    }
    return starts;
  };
  d.in_baseline = where_nothing_shows_it();
  d.speaks_for = {{"touch_onset", 1}, {"touch_end", 1}, {"plant_shift", 1}};
  d.tells_apart = "measure where the plant's root is in the frame of the robot";
  return d;
}

}  // namespace pedicel::discrepancy
