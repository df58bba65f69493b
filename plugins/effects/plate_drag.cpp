#include "engine/io/yaml.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Air drag of a plate: more along its normal than across. The plate turns with its segment.
EffectDefinition define_plate_drag() {
  EffectDefinition d;
  d.name = "plate_drag";
  // Two coefficients where a stem has one: a leaf that moves edge-on meets a fortieth of what it
  // meets flat (Hoerner: 0.03 against 1.17).
  d.plain_name = "air drag of a plate";
  d.sentence =
      "quadratic drag of each of two parts of the velocity: along a plate's normal, and across it";
  // Drag of the segments of curves. Blades of leaves have their own in a scene's wind.
  d.home = Home::air;
  d.family = Family::air;
  d.parameters = {{.name = "normal",
                   .unit = "m2/m",
                   .bounds = io::not_negative,
                   .sentence = "area per length along the normal, with Cd inside",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.05}},
                  {.name = "tangential",
                   .unit = "m2/m",
                   .bounds = io::not_negative,
                   // Each part has its own |v| v, as blades of leaves in a scene's wind have.
                   .sentence = "the same across the normal",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.005}},
                  {.name = "direction",
                   // As drawn, because people see how a leaf stands. From then on it goes with its
                   // segment.
                   .sentence = "of the normal, in the world as drawn; it turns with the stem",
                   .size = 3,
                   .role = Role::shape,
                   .first = {1.0, 0.0, 0.0}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    if (effect.numbers.contains("direction") &&
        Vec3(effect.numbers.at("direction").data()).isZero(0.0))
      node.error("plate_drag has a direction of length 0, expected a direction [x, y, z]");
  };
  d.change = ModelChange{
      Stage::laws, [](ModelTarget& t) {
        const double normal = t.number("normal"), tangential = t.number("tangential");
        // Air takes other kernels. No drag must keep the bits of no effect.
        if (normal == 0.0 && tangential == 0.0) return;
        // Its length says nothing, and must not scale the drag.
        const Vec3 direction = t.vector("direction").normalized();
        bool twice = false;
        // Others may have made the air of a segment already: only the plate's own numbers are set.
        t.model.air.resize(t.model.elements.size());
        t.each_span([&](const plant::RodPlaces::Span& span) {
          cosserat::SegmentAir& air = t.model.air[span.element];
          // A segment has one plate. Two of them have no common normal.
          twice = twice || air.has_plate();
          air.plate_normal = normal;
          air.plate_tangential = tangential;
          // Into the segment's axes, once.
          air.plate = t.model.elements[span.element].drawn_rotation.conjugate() * direction;
        });
        // After the loop, so that one error is said and not one for each segment.
        if (twice) t.error("plate_drag twice on one curve, expected it once");
      }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    // Held, and tried along three axes: of a direction in space no fit here has a free number.
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      starts.push_back(Start("plate_drag")
                           .fixed("direction", {direction.x(), direction.y(), direction.z()})
                           .positive("normal", 0.03, 1e-5, 10.0)
                           // A tenth of the other: a leaf is never quite flat.
                           .positive("tangential", 0.003, 1e-6, 10.0));
    return starts;
  };
  d.speaks_for = {{"damping", 5}, {"damping_by_amplitude", 4}, {"damping_by_mode", 4}};
  // A stem's own drag is the same either way.
  d.tells_apart = "release it along the plate and across it";
  return d;
}

}  // namespace pedicel::effects
