#include <cmath>
#include <numbers>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A steady wind.
EffectDefinition define_wind() {
  EffectDefinition d;
  d.name = "wind";
  d.plain_name = "a steady wind";
  // The drag of `leaf_drag`, with the air's velocity less the plant's. Without wind it is that,
  // which is why it has it as a special case.
  d.sentence = "quadratic drag in moving air";
  d.home = Home::air;
  d.family = Family::air;
  d.parameters = {{.name = "velocity",
                   .unit = "m/s",
                   .sentence = "of the air",
                   .size = 3,
                   // Not the size: at no speed there is still drag. The area is what makes it
                   // vanish.
                   .role = Role::shape,
                   .first = {2.0, 0.0, 0.0}},
                  {.name = "drag_area",
                   .unit = "m2/m",
                   .bounds = io::not_negative,
                   .sentence = "area per length, with Cd inside",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.005}}};
  d.change = ModelChange{Stage::laws, [](ModelTarget& t) {
                           t.each_air([&](cosserat::SegmentAir& air) {
                             air.drag_area += t.number("drag_area");
                             // A plant has one air, so winds of several effects add up.
                             air.velocity += t.vector("velocity");
                           });
                         }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    for (int i = 0; i < 4; ++i) {
      // Four ways along the ground. Drag goes with |v| v, which has no slope at zero speed, so no
      // start is there.
      const double angle = 0.5 * i * std::numbers::pi;
      const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
      // From a draught to a wind: the lean may be the same with another area, and then the damping
      // is another one.
      for (const double speed : {0.3, 1.5, 5.0})
        starts.push_back(Start("wind")
                             .vector("velocity", speed * along, 0.3, 30.0, 2)
                             .positive("drag_area", 0.02, 1e-4, 1.0)
                             // The lean knows speed squared times area alone. What is known of
                             // leaves keeps the two apart.
                             .prior(1.5, 0.02));
    }
    return starts;
  };
  d.speaks_for = {{"constant_offset", 2}, {"out_of_plane", 2}};
  d.tells_apart = "repeat a trial in still air";
  d.special_cases = {"leaf_drag"};
  return d;
}

}  // namespace pedicel::effects
