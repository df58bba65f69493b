#include <algorithm>

#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A gusting wind: velocity (1 + amplitude sin(2 pi frequency t)). Gusts of a plant have one
// frequency.
EffectDefinition define_gust() {
  EffectDefinition d;
  d.name = "gust";
  d.plain_name = "a gusting wind";
  d.sentence = "wind with velocity times 1 + amplitude sin(2 pi frequency t)";
  d.home = Home::air;
  d.family = Family::air;
  d.parameters = {{.name = "velocity",
                   .unit = "m/s",
                   .sentence = "of the air",
                   .size = 3,
                   .role = Role::shape,
                   .first = {2.0, 0.0, 0.0}},
                  {.name = "drag_area",
                   .unit = "m2/m",
                   .bounds = io::not_negative,
                   .sentence = "area per length, with Cd inside",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.005}},
                  {.name = "frequency",
                   .unit = "Hz",
                   .bounds = io::positive,
                   .sentence = "of the gusts",
                   .role = Role::shape,
                   .first = {0.5}},
                  {.name = "amplitude",
                   .bounds = io::not_negative,
                   .sentence = "of the gusts, relative to the velocity",
                   .role = Role::shape,
                   .first = {0.3}}};
  d.change = ModelChange{
      Stage::laws, [](ModelTarget& t) {
        const double frequency = t.number("frequency");
        if (t.model.gust_frequency != 0.0 && t.model.gust_frequency != frequency)
          t.error("a second gust of another frequency, expected gusts of one frequency");
        t.model.gust_frequency = frequency;
        t.each_air([&](cosserat::SegmentAir& air) {
          air.drag_area += t.number("drag_area");
          air.velocity += t.vector("velocity");
          air.gust += t.number("amplitude") * t.vector("velocity");
        });
      }};
  d.starts = [](const StartContext& c) {
    // A record of duration T parts frequencies 1/T from each other; halfway between two of these
    // starts a fit still slides to the right one.
    std::vector<Start> starts;
    const int count = std::clamp(static_cast<int>(1.8 * c.scales.duration), 6, 16);
    for (int f = 1; f <= count; ++f)
      for (int i = 0; i < 2; ++i)
        starts.push_back(
            Start("gust")
                .vector("velocity", 0.7 * (i ? Vec3::UnitY() : Vec3::UnitX()), 0.3, 30.0, 2)
                .positive("drag_area", 0.02, 1e-4, 1.0)
                .prior(1.5, 0.02)
                .positive("frequency", 1.9 * f / count, 0.03, 5.0)
                .positive("amplitude", 0.7, 1e-3, 5.0));
    return starts;
  };
  d.speaks_for = {{"out_of_plane", 3}};
  d.tells_apart = "repeat the same trial three times; what gusts do does not repeat";
  d.special_cases = {"leaf_drag", "wind"};
  return d;
}

}  // namespace pedicel::effects
