#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Mass that is spread otherwise along the curves: m (1 + gradient (s/L - 1/2)), positive
// everywhere.
EffectDefinition define_mass_distribution() {
  EffectDefinition d;
  d.name = "mass_distribution";
  d.plain_name = "mass spread otherwise along the curves";
  d.sentence = "density times 1 + gradient (s/L - 1/2) along a curve";
  d.home = Home::element;
  d.family = Family::mass;
  d.parameters = {{.name = "gradient",
                   // Below 2, where an end of the curve would have no mass.
                   .bounds = (io::Bounds{-1.99, 1.99}),
                   .sentence = "over the whole curve",
                   .vanishes = Vanishes::at_zero}};
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           t.scale_mass([&](const plant::RodPlaces::Span& span) {
                             // About the middle of the curve, so that the mass of a curve of even
                             // section stays: how heavy it is, is the density's business.
                             return t.along(span, t.number("gradient"));
                           });
                         }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // From either side, since it is far from linear near its bounds.
    return {Start("mass_distribution").signed_number("gradient", 0.2, 0.3, -1.95, 1.95),
            Start("mass_distribution").signed_number("gradient", -0.2, 0.3, -1.95, 1.95)};
  };
  return d;
}

}  // namespace pedicel::effects
