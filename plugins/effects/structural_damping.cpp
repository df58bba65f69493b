#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Damping that does not depend on the rate: Maxwell branches whose loss factor is even over the
// band of plants (cosserat::add_structural_damping()).
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
  d.instead_of = "damping_time";
  return d;
}

}  // namespace pedicel::effects
