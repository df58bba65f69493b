#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A branch whose junction gives: a spring in series with its first joint.
EffectDefinition define_attachment_compliance() {
  EffectDefinition d;
  d.name = "attachment_compliance";
  d.plain_name = "a branch whose junction gives";
  d.sentence = "a spring in series with the bending at a branch's junction";
  d.home = Home::joint;
  d.family = Family::softness;
  // Which branch: each has a junction of its own.
  d.needs_place = true;
  d.parameters = {{.name = "stiffness",
                   .unit = "N m/rad",
                   .bounds = io::positive,
                   .sentence = "of the spring",
                   // A stiff spring in series does nothing, so its unknown is a logarithm and the
                   // effect vanishes at its far end.
                   .vanishes = Vanishes::at_infinity,
                   .first = {5.0}}};
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           const int curve = t.plant.curve_index(t.effect.place->curve);
                           // The first span of a curve is the one at its junction: spans stand in
                           // the order of growth.
                           for (const plant::RodPlaces::Span& span : t.places.spans)
                             if (span.curve == curve)
                               return t.soften(span.element, t.number("stiffness"));
                           // A curve without elements of its own: its junction is the plant's first
                           // joint.
                           t.soften(0, t.number("stiffness"));
                         }};
  d.starts = [](const StartContext& c) {
    // Where a curve's nearer end is from the root; those nearest to it have no junction.
    const auto distance = [&](const plant::PlantCurve& curve) {
      return std::min((curve.points.front() - c.plant.root).norm(),
                      (curve.points.back() - c.plant.root).norm());
    };
    double nearest = 1e300;
    for (const plant::PlantCurve& curve : c.plant.curves)
      nearest = std::min(nearest, distance(curve));
    std::vector<Start> starts;
    // In units of the stem's own stiffness: what counts as soft depends on the plant.
    const double k = c.scales.root_stiffness;
    // A little softer than a rigid junction, and as soft as the stem. Between them a fit finds its
    // way.
    for (const plant::PlantCurve& curve : c.plant.curves)
      if (distance(curve) > nearest + 1e-9)
        for (const double part : {10.0, 1.0})
          starts.push_back(Start("attachment_compliance")
                               .place(curve.name, 0.0)
                               .positive("stiffness", part * k, 1e-5 * k, 1e4 * k));
    return starts;
  };
  // A solver that leads a branch into its stem in its own way makes such a spring: from the softest
  // that a discretisation can make to one that does nothing.
  d.at_junction = [](const std::string& curve, double softest) {
    // About a stiff joint, and wide: a factor of seven either way is nothing unusual.
    return Start("attachment_compliance")
        .place(curve, 0.0)
        .positive("stiffness", 4.0 * softest, softest, 1e3 * softest)
        .prior(2.0, 8.0 * softest);
  };
  d.speaks_for = {{"junction_kink", 1}};
  d.tells_apart = "put a marker on either side of the junction";
  return d;
}

}  // namespace pedicel::effects
