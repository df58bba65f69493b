#include <algorithm>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_payload() {
  SceneEffectDefinition d;
  d.name = "payload";
  d.plain_name = "a load at the tool";
  d.sentence = "the tool carries a mass that its file does not have";
  d.home = SceneHome::arm;
  d.is_only_seen = true;
  d.parameters = {
      {.name = "mass",
       .unit = "kg",
       .bounds = io::not_negative,
       .sentence = "point mass",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
      {.name = "centre",
       .unit = "m",
       .bounds = io::any_number,
       .sentence = "where it sits, in the tool's link",
       .size = 3,
       .required = false,
       .otherwise = "its origin",
       .vanishes = effects::Vanishes::never,
       .first = {0.0, 0.0, 0.0}},
  };
  d.apply = [](const SceneEffectTarget& t) {
    const double mass = t.number("mass"), before = t.state.payload;
    const Vec3 centre = t.has("centre") ? t.vector("centre") : Vec3(0, 0, 0);
    if (mass + before > 0.0)
      t.state.payload_centre = (before * t.state.payload_centre + mass * centre) / (before + mass);
    t.state.payload = before + mass;
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    if (c.experiment.wrenches.empty() &&
        std::ranges::none_of(c.experiment.trials,
                             [](const Trial& trial) { return trial.torques.size() > 0; }))
      return {};
    // Where it sits shows by mass times lever alone: begun with a tenth of its mass, it would be
    // put ten times as far away.
    std::vector<effects::Start> starts;
    for (const double mass : {0.02, 0.08, 0.4})
      starts.push_back(effects::Start("payload")
                           .signed_number("mass", mass, 0.02, 0.0, 50.0)
                           .vector("centre", Vec3::Zero(), 0.02, 1.0));
    return starts;
  };
  d.speaks_for = {{"wrench_at_rest", 2}, {"moment_at_rest", 2}};
  d.tells_apart = "hold the tool still in several orientations, away from the plant";
  return d;
}

}  // namespace pedicel::discrepancy
