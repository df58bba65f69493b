#include <numbers>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A root that turns elastically: a spring in series with the clamp.
EffectDefinition define_base_compliance() {
  EffectDefinition d;
  d.name = "base_compliance";
  d.plain_name = "a root that turns elastically";
  d.sentence = "a spring in series with the root's bending; it has no damper";
  d.home = Home::base;
  d.family = Family::softness;
  d.parameters = {{.name = "stiffness",
                   .unit = "N m/rad",
                   .bounds = io::positive,
                   // In N m/rad, at the first joint's two bending axes alike.
                   .sentence = "of the spring",
                   .vanishes = Vanishes::at_infinity,
                   .first = {5.0}}};
  // In series with the bending of the first joint, and no joint of its own: the tree keeps its
  // elements, and rows and meshes stay as they are.
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           // All that is clamped: a plant may have several stems at its root, each
                           // with a joint of its own.
                           for (int e = 0; e < t.model.size(); ++e)
                             if (t.model.elements[e].parent < 0) t.soften(e, t.number("stiffness"));
                         }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const double k = c.scales.root_stiffness;
    // Stiffer than the stem by far, and not so far: in between a fit finds its way. A root that is
    // softer than its stem is within the bounds, and is reached from the second one.
    for (const double part : {30.0, 5.0})
      starts.push_back(Start("base_compliance").positive("stiffness", part * k, 1e-3 * k, 1e4 * k));
    return starts;
  };
  // By rank: a turn about the root is its own sign, and all others it shares with the modulus.
  d.speaks_for = {{"frequency", 4},
                  {"force_scale", 3},
                  // In degrees. The moment there is about that of the sharpest bend of the trials.
                  {"base_rotation", 1, "stiffness",
                   [](double degrees, const StartContext& c) {
                     return c.scales.root_stiffness * c.scales.length * c.scales.curvature /
                            (degrees * std::numbers::pi / 180.0);
                   }},
                  {"dynamic_over_static", 3}};
  d.tells_apart = "put a marker on the collar at the root";
  return d;
}

}  // namespace pedicel::effects
