#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Friction that gives way little by little, and remembers where it turned:
// dz/dphi = K (1 - |z/moment|^exponent sign(dphi z)). The formula is in hysteresis-inl.h.
EffectDefinition define_hysteresis() {
  EffectDefinition d;
  d.name = "hysteresis";
  d.plain_name = "a stem that remembers how it was bent";
  d.sentence =
      "M = (1 - ratio) K phi + ratio z, z Bouc-Wen's: as K phi after each turn, up to a moment; "
      "exponent 1 is Dahl's";
  d.home = Home::joint;
  d.family = Family::memory;
  // At each joint, as z is a moment. So it holds for one mesh as for another.
  d.parameters = {{.name = "moment",
                   .unit = "N m",
                   .bounds = io::positive,
                   .sentence = "that z grows to at most",
                   .role = Role::shape,
                   .first = {0.01}},
                  {.name = "exponent",
                   // From 1 on: below it the right side would be infinitely steep at z = 0. Far
                   // above it the law is a slider's.
                   .bounds = (io::Bounds{1.0, 100.0}),
                   .sentence = "how late z gives way",
                   .role = Role::shape,
                   .first = {1.0}},
                  {.name = "ratio",
                   .bounds = io::fraction,
                   .sentence = "part of the stiffness that gives way",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.3}}};
  d.change = ModelChange{Stage::laws, [](ModelTarget& t) {
                           const double ratio = t.number("ratio");
                           // No branch at all, so that a plant without it keeps the bits and the
                           // speed of one without laws.
                           if (ratio == 0.0) return;
                           t.each_law([&](int, cosserat::JointLaw& law) {
                             // z is of the whole stiffness K in the formula. The branch has the
                             // share `ratio` of it, and so of the moment.
                             cosserat::add_hysteresis(law, ratio, ratio * t.number("moment"),
                                                      t.number("exponent"));
                           });
                         }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // The moment at the root in the largest bend of the trials: EI times curvature. Far above it
    // nothing slips.
    const double largest = c.scales.root_stiffness * c.scales.length * c.scales.curvature;
    for (const double part : {0.1, 0.5})
      starts.push_back(Start("hysteresis")
                           // Dahl's. An exponent is hardly seen in data, and would cost a number.
                           .fixed("exponent", {1.0})
                           .positive("moment", part * largest, 1e-4 * largest, 20 * largest)
                           .positive("ratio", 0.2, 1e-3, 0.95));
    return starts;
  };
  d.speaks_for = {{"loop_area", 5},
                  {"drive_history", 3},
                  {"frequency_by_amplitude", 6},
                  {"damping_by_amplitude", 6}};
  // A slider has no memory within its loop. This law has one for each turn.
  d.tells_apart = "push to and fro by less and less: loops within loops";
  return d;
}

}  // namespace pedicel::effects
