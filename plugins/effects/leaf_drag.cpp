#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Air drag of the leaves, in still air.
EffectDefinition define_leaf_drag() {
  EffectDefinition d;
  d.name = "leaf_drag";
  d.plain_name = "air drag of the leaves";
  d.sentence = "quadratic drag in still air";
  d.home = Home::air;
  d.family = Family::air;
  d.parameters = {{.name = "drag_area",
                   .unit = "m2/m",
                   .bounds = io::not_negative,
                   .sentence = "area per length, with Cd inside",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.005}}};
  d.change = ModelChange{
      Stage::laws, [](ModelTarget& t) {
        t.each_air([&](cosserat::SegmentAir& air) { air.drag_area += t.number("drag_area"); });
      }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    for (const double area : {0.01, 0.1})
      starts.push_back(Start("leaf_drag").positive("drag_area", area, 1e-5, 10.0));
    return starts;
  };
  d.speaks_for = {{"damping", 4}, {"damping_by_amplitude", 1}, {"damping_by_mode", 3}};
  d.tells_apart = "take off or wet the leaves and repeat the release";
  return d;
}

}  // namespace pedicel::effects
