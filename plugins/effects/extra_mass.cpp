#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A point mass that the drawing lacks.
EffectDefinition define_extra_mass() {
  EffectDefinition d;
  d.name = "extra_mass";
  d.plain_name = "a mass that the model lacks";
  d.sentence = "a point mass";
  d.home = Home::element;
  d.family = Family::mass;
  d.needs_place = true;
  d.parameters = {{.name = "mass",
                   .unit = "kg",
                   .bounds = io::positive,
                   .sentence = "of the point",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.01}}};
  d.change =
      ModelChange{Stage::constants, [](ModelTarget& t) {
                    const plant::PlacedPoint place = t.places.locate(
                        t.plant.curve_index(t.effect.place->curve), t.effect.place->at);
                    // A point without a size: its own turning inertia is nothing beside what its
                    // place gives.
                    t.model.masses.push_back({place.element, place.back, t.number("mass"), 0.0});
                    // At once, since later effects may scale what is there.
                    cosserat::lump_inertia(t.model, place.element);
                  }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const double m = c.scales.mass;
    // Its place is a narrow valley, so that each curve is entered from three. Near the root a mass
    // hardly moves and does nothing.
    for (const plant::PlantCurve& curve : c.plant.curves)
      for (const double at : {0.35, 0.65, 0.95})
        starts.push_back(Start("extra_mass")
                             .moving_place(curve.name, at)
                             // In units of the plant's own mass, so that one start does for a
                             // seedling and for a tree.
                             .positive("mass", 0.1 * m, 1.0e-4 * m, 30.0 * m));
    return starts;
  };
  d.speaks_for = {{"frequency", 3}, {"excess_curvature", 3}, {"dynamic_over_static", 4}};
  // Frequencies alone cannot: a mass near the tip and a softer stem slow a swing alike.
  d.tells_apart = "weigh the plant, or hang a known mass beside the suspected one";
  return d;
}

}  // namespace pedicel::effects
