#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Damping that does not depend on the rate: Maxwell branches whose loss factor is even over the
// band of plants (cosserat::add_structural_damping()).
// Wood and stems lose about the same share of energy in each cycle, whatever its rate. Kelvin-Voigt
// damping does not: it grows with the frequency. Eight branches from 0.007 to 280 Hz keep the loss
// factor even to 3 %.
EffectDefinition define_structural_damping() {
  EffectDefinition d;
  d.name = "structural_damping";
  d.plain_name = "damping that does not depend on the rate";
  d.sentence = "damping that hardly depends on the rate";
  d.home = Home::joint;
  d.family = Family::memory;
  d.parameters = {{.name = "loss_factor",
                   .bounds = io::not_negative,
                   .sentence = "twice the damping ratio",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.05}},
                  {.name = "frequency",
                   .unit = "Hz",
                   .bounds = io::positive,
                   // By causality a loss factor comes with a modulus that rises with the rate, by
                   // some (2/pi) g a factor e. At one frequency only it is the file's.
                   .sentence = "where the modulus is the file's",
                   .required = false,
                   .otherwise = "2",
                   .offered = false,
                   .role = Role::shape,
                   .first = {1.0}}};
  d.change =
      ModelChange{Stage::laws, [](ModelTarget& t) {
                    const double frequency = t.has("frequency") ? t.number("frequency") : 2.0;
                    t.each_law([&](int, cosserat::JointLaw& law) {
                      // Beside other branches, whose shares add up.
                      cosserat::add_structural_damping(law, t.number("loss_factor"), frequency);
                    });
                  }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // Where the modulus of the settled shape is met again, solvers and materials differ.
    return {Start("structural_damping")
                .positive("loss_factor", 0.05, 1e-4, 2.0)
                .positive("frequency", 2.0, 0.01, 200.0)
                .prior(1.5, 2.0)};
  };
  d.speaks_for = {{"damping", 3}, {"frequency_by_amplitude", 3}, {"damping_by_mode", 2}};
  // Of one mode in the data it says the same.
  d.instead_of = "damping_time";
  return d;
}

}  // namespace pedicel::effects
