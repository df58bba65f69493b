#include "plugins/effects/registry/effect_definition.h"

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
                   // Below 2, where an end of the curve would have no stiffness.
                   .bounds = (io::Bounds{-1.99, 1.99}),
                   .sentence = "over the whole curve",
                   .vanishes = Vanishes::at_zero}};
  d.change = ModelChange{
      Stage::constants, [](ModelTarget& t) {
        const double gradient = t.number("gradient");
        t.each_span([&](const plant::RodPlaces::Span& span) {
          // Stretch is a segment's own, and is taken at its middle. A bend is the joint's, which
          // stands at its near end.
          t.model.elements[span.element].stretch_stiffness *= t.along(span, gradient);
          // At a clamp the joint stands for the first half of its own segment alone.
          t.model.elements[span.element].bend_stiffness *= t.along_at_joint(span, gradient);
        });
      }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // About the middle of the curve, so that it hardly mimics another modulus.
    return {Start("stiffness_gradient").signed_number("gradient", 0.2, 0.3, -1.95, 1.95),
            Start("stiffness_gradient").signed_number("gradient", -0.2, 0.3, -1.95, 1.95)};
  };
  // It bends one half more and the other one less than the model.
  d.speaks_for = {{"excess_curvature", 2}};
  return d;
}

}  // namespace pedicel::effects
