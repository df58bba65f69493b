#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Air drag of the leaves, in still air.
EffectDefinition define_leaf_drag() {
  EffectDefinition d;
  d.name = "leaf_drag";
  d.plain_name = "air drag of the leaves";
  // Quadratic, as for leaves in motion the Reynolds number is far above 1. So it damps wide swings
  // more than narrow ones, which is how it is told from all other damping.
  d.sentence = "quadratic drag in still air";
  d.home = Home::air;
  d.family = Family::air;
  d.parameters = {{.name = "drag_area",
                   .unit = "m2/m",
                   .bounds = io::not_negative,
                   // Area and coefficient are only seen as a product.
                   .sentence = "area per length, with Cd inside",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.005}}};
  d.change = ModelChange{
      Stage::laws, [](ModelTarget& t) {
        // Per metre of the curves that carry the leaves, with Cd inside: the leaves themselves are
        // not drawn here.
        t.each_air([&](cosserat::SegmentAir& air) { air.drag_area += t.number("drag_area"); });
      }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    // A stem with few leaves, and a dense one: 0.01 m2 a metre is a strip of a centimetre.
    for (const double area : {0.01, 0.1})
      starts.push_back(Start("leaf_drag").positive("drag_area", area, 1e-5, 10.0));
    return starts;
  };
  d.speaks_for = {{"damping", 4}, {"damping_by_amplitude", 1}, {"damping_by_mode", 3}};
  d.tells_apart = "take off or wet the leaves and repeat the release";
  return d;
}

}  // namespace pedicel::effects
