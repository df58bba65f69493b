#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A gusting wind: velocity (1 + amplitude sin(2 pi frequency t)). Gusts of a plant have one
// frequency.
// One sine and no spectrum: a fit has to find it in one record, and turbulence of a scene is the
// business of its `wind`.
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
        // Refused and not added up: the solver has one sine for all segments of a plant.
        const double frequency = t.number("frequency");
        // The air of all segments has one phase: the sine is computed once a step.
        if (t.model.gust_frequency != 0.0 && t.model.gust_frequency != frequency)
          t.error("a second gust of another frequency, expected gusts of one frequency");
        t.model.gust_frequency = frequency;
        t.each_air([&](cosserat::SegmentAir& air) {
          air.drag_area += t.number("drag_area");
          // Winds, gusts and drag add up, because a plant has one air.
          air.velocity += t.vector("velocity");
          // Relative to the mean, and along it: drag goes with the square, so the mean decides how
          // much a gust does.
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
                // Two horizontal components of three: a wind over a plant blows along the ground.
                // One start a horizontal axis is enough, as the components are free.
                .vector("velocity", 0.7 * (i ? Vec3::UnitY() : Vec3::UnitX()), 0.3, 30.0, 2)
                .positive("drag_area", 0.02, 1e-4, 1.0)
                // Speed and area make one product, the drag. What is known of leaves keeps them
                // apart.
                .prior(1.5, 0.02)
                // Up to some 2 Hz, as many starts as the record parts in there.
                .positive("frequency", 1.9 * f / count, 0.03, 5.0)
                .positive("amplitude", 0.7, 1e-3, 5.0));
    return starts;
  };
  // Behind anisotropy and a steady wind, which are simpler.
  d.speaks_for = {{"out_of_plane", 3}};
  d.tells_apart = "repeat the same trial three times; what gusts do does not repeat";
  // Without an amplitude it is wind, and without a velocity drag. Its fit goes on from theirs.
  d.special_cases = {"leaf_drag", "wind"};
  return d;
}

}  // namespace pedicel::effects
