#include <algorithm>
#include <cmath>

#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A stretch of a curve that is softer (or stiffer). A joint whose half segments reach into it has
// their share of its compliance raised.
EffectDefinition define_weak_segment() {
  EffectDefinition d;
  d.name = "weak_segment";
  d.plain_name = "a weak stretch";
  d.sentence = "multiplies EI and GJ over a stretch";
  d.home = Home::joint;
  d.family = Family::softness;
  d.needs_place = true;
  d.parameters = {{.name = "factor",
                   .bounds = io::positive,
                   .sentence = "on EI and GJ",
                   .vanishes = Vanishes::at_one,
                   .first = {0.5}},
                  {.name = "length",
                   .unit = "m",
                   .bounds = io::positive,
                   .sentence = "of the stretch",
                   .role = Role::shape,
                   .first = {0.02}}};
  d.change = ModelChange{
      Stage::constants, [](ModelTarget& t) {
        const int curve = t.plant.curve_index(t.effect.place->curve);
        const double centre = t.effect.place->at * t.places.curve_lengths[curve];
        const double half = 0.5 * t.number("length");
        for (const plant::RodPlaces::Span& span : t.places.spans) {
          if (span.curve != curve) continue;
          const double low = std::min(span.arc_near, span.arc_far);
          const double length = std::abs(span.arc_far - span.arc_near);
          // The joint at the near end stands for half a segment on either side of it.
          const double from = span.arc_near - 0.5 * length, to = span.arc_near + 0.5 * length;
          const double shared = std::max(
              0.0, std::min({to, centre + half, low + length}) - std::max(from, centre - half));
          const double share = std::min(1.0, shared / length);
          t.model.elements[span.element].bend_stiffness /= 1.0 - share + share / t.number("factor");
        }
      }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    for (const plant::PlantCurve& curve : c.plant.curves) {
      double drawn = 0.0;
      for (std::size_t i = 1; i < curve.points.size(); ++i)
        drawn += (curve.points[i] - curve.points[i - 1]).norm();
      const double length = 0.1 * drawn;
      for (const double at : {0.04, 0.15, 0.4, 0.7})
        starts.push_back(Start("weak_segment")
                             .moving_place(curve.name, at)
                             .positive("factor", 0.6, 0.01, 10.0)
                             .positive("length", length, 0.2 * length, 5.0 * length)
                             .prior(0.5, length));
    }
    return starts;
  };
  d.speaks_for = {{"base_rotation", 3}, {"excess_curvature", 1}, {"junction_kink", 2}};
  d.limits = {{"length", false, "base_compliance"}, {"length", false, "attachment_compliance"}};
  return d;
}

}  // namespace pedicel::effects
