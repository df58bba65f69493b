#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Damping proportional to mass.
EffectDefinition define_mass_damping() {
  EffectDefinition d;
  d.name = "mass_damping";
  d.plain_name = "damping proportional to mass";
  // Rayleigh's other half: damping by mass takes most from slow modes, damping by stiffness
  // (Kelvin-Voigt) from fast ones. With one mode in the data the two cannot be told apart.
  d.sentence = "force -rate m v";
  // On each element's own velocity, as if the air about it held it: no joint has to bend.
  d.home = Home::element;
  d.family = Family::memory;
  d.parameters = {{.name = "rate",
                   .unit = "1/s",
                   .bounds = io::not_negative,
                   .sentence = "of the force",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.5}}};
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           // It adds up, as rates of one law do.
                           for (cosserat::Element& element : t.model.elements)
                             element.mass_damping += t.number("rate");
                         }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // In 1/s, twice the damping ratio times the frequency in rad/s.
    return {Start("mass_damping").positive("rate", 0.3, 1e-4, 1e3)};
  };
  d.speaks_for = {{"damping", 2}, {"damping_by_mode", 1}};
  // Where one mode swings it explains what a longer damping time does, and the verdict weighs the
  // two.
  d.instead_of = "damping_time";
  return d;
}

}  // namespace pedicel::effects
