#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A modulus that changes along the curves: E (1 + gradient (s/L - 1/2)), positive everywhere.
EffectDefinition define_stiffness_gradient() {
  EffectDefinition d;
  d.name = "stiffness_gradient";
  d.plain_name = "a modulus that changes along the curves";
  d.sentence = "E times 1 + gradient (s/L - 1/2) along a curve";
  d.home = Home::joint;
  d.family = Family::softness;
  d.parameters = {{.name = "gradient",
                   .bounds = (io::Bounds{-1.99, 1.99}),
                   .sentence = "over the whole curve",
                   .vanishes = Vanishes::at_zero}};
  d.change = ModelChange{
      Stage::constants, [](ModelTarget& t) {
        const double gradient = t.number("gradient");
        t.each_span([&](const plant::RodPlaces::Span& span) {
          t.model.elements[span.element].stretch_stiffness *= t.along(span, gradient);
          t.model.elements[span.element].bend_stiffness *= t.along_at_joint(span, gradient);
        });
      }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    return {Start("stiffness_gradient").signed_number("gradient", 0.2, 0.3, -1.95, 1.95),
            Start("stiffness_gradient").signed_number("gradient", -0.2, 0.3, -1.95, 1.95)};
  };
  d.speaks_for = {{"excess_curvature", 2}};
  return d;
}

}  // namespace pedicel::effects
