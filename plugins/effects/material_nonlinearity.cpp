#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A material that hardens or softens: M = EI k (1 + coefficient k^2 / k0^2). The formula is in
// material_nonlinearity-inl.h.
EffectDefinition define_material_nonlinearity() {
  EffectDefinition d;
  d.name = "material_nonlinearity";
  d.plain_name = "a material that is not linear";
  d.sentence = "M = EI k (1 + coefficient (k/k0)^2)";
  d.home = Home::joint;
  d.family = Family::nonlinearity;
  d.parameters = {{.name = "coefficient",
                   // Even in k: both sides of the stem are alike. What is not is `asymmetry`.
                   .sentence = "above 0 stiffens, below 0 softens",
                   .vanishes = Vanishes::at_zero},
                  {.name = "k0",
                   .unit = "1/m",
                   .bounds = io::positive,
                   .sentence = "scale of the curvature",
                   .role = Role::shape,
                   .first = {10.0}}};
  d.change = ModelChange{Stage::laws, [](ModelTarget& t) {
                           t.each_law([&](int e, cosserat::JointLaw& law) {
                             // A bend in radians, so that the law is the same on every mesh.
                             const double bend = t.number("k0") * t.joint_length(e);
                             // Coefficients add up, as the law is linear in them.
                             law.term("material_nonlinearity") +=
                                 t.number("coefficient") / (bend * bend);
                           });
                         }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // Either sign: over zero a fit would have to pass a model without the effect.
    for (const double b : {0.1, -0.1})
      starts.push_back(Start("material_nonlinearity")
                           // Only coefficient over k0 squared is seen. With the largest curvature
                           // of the trials as k0 the coefficient says what it does there.
                           .fixed("k0", {c.scales.curvature})
                           .signed_number("coefficient", b, 0.2, -20.0, 20.0));
    return starts;
  };
  // Wide swings are faster where it hardens, and slower where it softens.
  // In per cent, wide swings less narrow ones. Over a swing the law is stiffer by 3/4 of what it is
  // at the swing's end, and a frequency goes with the root. Wide swings are taken to reach k0.
  d.speaks_for = {{"frequency_by_amplitude", 1, "coefficient",
                   [](double percent, const StartContext&) { return 8.0 / 3.0 * 0.01 * percent; }},
                  {"damping_by_amplitude", 3}};
  return d;
}

}  // namespace pedicel::effects
