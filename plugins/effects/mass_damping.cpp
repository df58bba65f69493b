#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Damping proportional to mass.
EffectDefinition define_mass_damping() {
  EffectDefinition d;
  d.name = "mass_damping";
  d.plain_name = "damping proportional to mass";
  d.sentence = "force -rate m v";
  d.home = Home::element;
  d.family = Family::memory;
  d.parameters = {{.name = "rate",
                   .unit = "1/s",
                   .bounds = io::not_negative,
                   .sentence = "of the force",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.5}}};
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           for (cosserat::Element& element : t.model.elements)
                             element.mass_damping += t.number("rate");
                         }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    return {Start("mass_damping").positive("rate", 0.3, 1e-4, 1e3)};
  };
  d.speaks_for = {{"damping", 2}, {"damping_by_mode", 1}};
  d.instead_of = "damping_time";
  return d;
}

}  // namespace pedicel::effects
