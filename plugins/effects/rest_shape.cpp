#include <vector>

#include "engine/io/yaml.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

namespace {

using Span = plant::RodPlaces::Span;

// The stretch of a curve that bends in the joint at a span's near end, m along the curve as drawn
// in the direction of growth: half of the span, and half of the one that it grows from.
// A curvature is spread over a length, and a joint bends at a point. Each joint gets the turn of
// the stretch that it stands for, so that the sum over a curve is the same on every mesh.
struct Stretch {
  double from = 0.0, to = 0.0;
  double middle() const { return 0.5 * (from + to); }
  // With its sign, which turns the bend round for a curve that is drawn against its growth.
  double rise() const { return to - from; }  // below 0 where the curve is drawn towards the root
};

Stretch stretch_of(const ModelTarget& t, const Span& span, const std::vector<const Span*>& by) {
  Stretch bent{span.arc_near, 0.5 * (span.arc_near + span.arc_far)};
  const int parent = t.model.elements[span.element].parent;
  const Span* before = parent < 0 ? nullptr : by[parent];
  // Where a curve starts from another one, that one's half keeps its shape.
  // Equal to the bit, since both ends are one number of the builder.
  if (before && before->curve == span.curve && before->arc_far == span.arc_near)
    bent.from = 0.5 * (before->arc_near + before->arc_far);
  return bent;
}

void bend(ModelTarget& t) {
  // Bends are vectors across the tangent. The normal fixes which of two is the first, along the
  // whole curve.
  const Vec3 normal = t.vector("normal");
  const std::vector<double>& curvature = t.effect.numbers.at("curvature");
  const std::vector<double>& gradient = t.effect.numbers.at("gradient");
  std::vector<const Span*> by(t.model.elements.size(), nullptr);
  // By element, because a joint asks for the one that carries it, which may be of another curve.
  for (const Span& span : t.places.spans) by[span.element] = &span;
  bool along = false;
  t.each_span([&](const Span& span) {
    const Stretch bent = stretch_of(t, span, by);
    cosserat::Element& element = t.model.elements[span.element];
    Vec3 tangent = element.drawn_rotation * Vec3::UnitZ();
    // Growth goes from the root outward, and a curve may be drawn against it. What the file says is
    // about the curve as drawn.
    if (bent.rise() < 0.0) tangent = -tangent;
    Vec3 e1 = normal - normal.dot(tangent) * tangent;
    // Along the tangent a normal has no part across, and e1 would be made of rounding.
    along = along || e1.norm() < 1.0e-3 * normal.norm();
    if (along) return;
    e1.normalize();
    const Vec3 e2 = tangent.cross(e1);
    const double s = bent.middle() - 0.5 * t.places.curve_lengths[span.curve];
    // Along the curve it turns by this; against it, which `rise` knows, the other way.
    const Vec3 turn = bent.rise() * ((curvature[0] + gradient[0] * s) * e1 +
                                     (curvature[1] + gradient[1] * s) * e2);
    // No turn must keep the bits of the drawn shape.
    if (turn.isZero(0.0)) return;
    const Vec3 in_frame = element.drawn_rotation.conjugate() * turn;
    // From the right, in the element's axes, as bends of a joint are. The drawn shape stays: only
    // what it is without load changes.
    element.rest_rotation = (element.rest_rotation * cosserat::exp_map(in_frame)).normalized();
  });
  if (along)
    t.error("rest_shape has a normal along the curve, expected one across it everywhere on it");
}

// A unit vector across the chord of a curve: of the world's axes the one that is farthest from it.
// Any axis across would do. This one is never near to being along, and is the same for the same
// curve.
Vec3 across(const plant::PlantCurve& curve) {
  const Vec3 chord = (curve.points.back() - curve.points.front()).cwiseAbs();
  int axis = 0;
  chord.minCoeff(&axis);
  return Vec3::Unit(axis);
}

}  // namespace

// A thing that is curved without load otherwise than its file says, where that shape is not known.
EffectDefinition define_rest_shape() {
  EffectDefinition d;
  d.name = "rest_shape";
  d.plain_name = "a curve that is bent otherwise without load";
  d.sentence =
      "adds curvature + gradient (s - L/2) to the unloaded shape, about e1 = normal and e2 = "
      "tangent "
      "x e1; s runs along a curve of length L as drawn";
  d.home = Home::joint;
  d.family = Family::frame;
  d.parameters = {{.name = "curvature",
                   .unit = "1/m",
                   .sentence = "about e1 and e2, in the middle of the curve",
                   .size = 2,
                   .vanishes = Vanishes::at_zero,
                   .first = {0.3, 0.0}},
                  {.name = "gradient",
                   .unit = "1/m2",
                   .sentence = "of that curvature along the curve",
                   .size = 2,
                   .vanishes = Vanishes::at_zero,
                   .first = {0.0, 0.0}},
                  {.name = "normal",
                   .sentence = "across the curve, in the world as drawn; its part across counts",
                   .size = 3,
                   .role = Role::shape,
                   .first = {0.0, 1.0, 0.0}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    if (effect.numbers.contains("normal") && Vec3(effect.numbers.at("normal").data()).isZero(0.0))
      node.error("rest_shape has a normal of length 0, expected a direction [x, y, z]");
  };
  d.change = ModelChange{Stage::constants, bend};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // In units of one radian over the longest curve: 0.03 is a bow that is hardly seen, 10 is more
    // than a full turn.
    const double small = 0.03 / c.scales.length, most = 10.0 / c.scales.length;
    for (const plant::PlantCurve& curve : c.plant.curves) {
      const Vec3 normal = across(curve);
      // In either plane. Both components are free, but a start at zero of both has no direction to
      // test.
      for (const bool first : {true, false})
        starts.push_back(
            Start("rest_shape")
                .place(curve.name, 0.5)
                .fixed("normal", {normal.x(), normal.y(), normal.z()})
                .pair("curvature", first ? small : 0.0, first ? 0.0 : small, small, most)
                .pair("gradient", 0.0, 0.0, small / c.scales.length, most / c.scales.length));
    }
    return starts;
  };
  d.speaks_for = {{"excess_curvature", 3}, {"constant_offset", 3}};
  d.tells_apart = "turn it about its own axis: its own shape turns with it, what hangs does not";
  return d;
}

}  // namespace pedicel::effects
