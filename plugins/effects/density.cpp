#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Density of the stems, as a factor on what the file says; part of every baseline.
EffectDefinition define_density() {
  EffectDefinition d;
  d.name = "density";
  d.plain_name = "another density";
  d.sentence = "multiplies the density of the plant";
  d.home = Home::material;
  d.parameters = {{.name = "factor",
                   .bounds = io::positive,
                   .sentence = "on the nominal value",
                   .vanishes = Vanishes::at_one,
                   .first = {1.0}}};
  d.change =
      ModelChange{Stage::constants, [](ModelTarget& t) {
                    t.scale_mass([&](const plant::RodPlaces::Span&) { return t.number("factor"); });
                  }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // The prior is wide; it only keeps apart what some data leave entirely open (a free vibration
    // sees modulus over density alone).
    return {Start("density").positive("factor", 1.0, 1.0 / 10.0, 10.0).prior(0.1, 1.0)};
  };
  d.speaks_for = {{"frequency", 2}};
  d.material = &plant::MaterialValues::density;
  d.known_to = &plant::MaterialKnowledge::density;
  d.material_unit = "kg/m3";
  d.less = "lighter";
  d.more = "heavier";
  return d;
}

}  // namespace pedicel::effects
