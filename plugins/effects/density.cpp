#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Density of the stems, as a factor on what the file says; part of every baseline.
EffectDefinition define_density() {
  EffectDefinition d;
  d.name = "density";
  d.plain_name = "another density";
  d.sentence = "multiplies the density of the plant";
  // A factor on all curves, so that those with a density of their own keep their ratios.
  d.home = Home::material;
  d.parameters = {{.name = "factor",
                   .bounds = io::positive,
                   .sentence = "on the nominal value",
                   .vanishes = Vanishes::at_one,
                   .first = {1.0}}};
  d.change =
      ModelChange{Stage::constants, [](ModelTarget& t) {
                    // Of the segments' own sections. Fruits and hung masses are stated in kg, and
                    // stay.
                    t.scale_mass([&](const plant::RodPlaces::Span&) { return t.number("factor"); });
                  }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // 10 %, far narrower than those of modulus and damping, since a plant is weighed. It also
    // breaks the tie of a free swing, which sees modulus over density alone.
    return {Start("density").positive("factor", 1.0, 1.0 / 10.0, 10.0).prior(0.1, 1.0)};
  };
  d.speaks_for = {{"frequency", 2}};
  d.material = &plant::material_key(plant::MaterialRole::mass);
  // For the sentence of a verdict, which says what a factor means.
  d.less = "lighter";
  d.more = "heavier";
  return d;
}

}  // namespace pedicel::effects
