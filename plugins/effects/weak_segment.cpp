#include <algorithm>
#include <cmath>

#include "plugins/effects/registry/effect_definition.h"

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
  // Softness and length mimic each other: a stretch that is half as long and bends twice as much
  // turns what it carries alike. So the length has a prior.
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
        // In m along the curve as drawn, as spans are.
        const double centre = t.effect.place->at * t.places.curve_lengths[curve];
        const double half = 0.5 * t.number("length");
        // By overlap and not by the nearest joint: the effect moves smoothly as its place does, and
        // a fit can follow.
        for (const plant::RodPlaces::Span& span : t.places.spans) {
          if (span.curve != curve) continue;
          const double length = std::abs(span.arc_far - span.arc_near);
          // The joint at the near end stands for half a segment on either side of it. At a clamp
          // there is nothing on the near side, so it stands for half a segment in all.
          const bool clamped = t.model.elements[span.element].parent < 0;
          double from = span.arc_near - 0.5 * length, to = span.arc_near + 0.5 * length;
          if (clamped) (span.arc_near < span.arc_far ? from : to) = span.arc_near;
          // Compliances add up in series, so the share of the length is the share of the
          // compliance.
          const double shared =
              std::max(0.0, std::min(to, centre + half) - std::max(from, centre - half));
          // Rounding may make it a little more than all.
          const double share = std::min(1.0, shared / (to - from));
          t.model.elements[span.element].bend_stiffness /= 1.0 - share + share / t.number("factor");
        }
      }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    for (const plant::PlantCurve& curve : c.plant.curves) {
      double drawn = 0.0;
      for (std::size_t i = 1; i < curve.points.size(); ++i)
        drawn += (curve.points[i] - curve.points[i - 1]).norm();
      // A tenth of the curve: shorter ones act like a hinge, and longer ones like another modulus.
      const double length = 0.1 * drawn;
      // Denser towards the root, where the moments are and a weak place does most.
      for (const double at : {0.04, 0.15, 0.4, 0.7})
        starts.push_back(Start("weak_segment")
                             .moving_place(curve.name, at)
                             .positive("factor", 0.6, 0.01, 10.0)
                             .positive("length", length, 0.2 * length, 5.0 * length)
                             // Known to a factor of e^0.5 beforehand, where the data do not tell.
                             .prior(0.5, length));
    }
    return starts;
  };
  d.speaks_for = {{"base_rotation", 3}, {"excess_curvature", 1}, {"junction_kink", 2}};
  // A stretch without a length is a hinge: at the root or at a junction it has a name of its own.
  d.limits = {{"length", false, "base_compliance"}, {"length", false, "attachment_compliance"}};
  return d;
}

}  // namespace pedicel::effects
