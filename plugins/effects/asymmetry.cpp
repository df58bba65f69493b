#include <algorithm>
#include <numbers>

#include "engine/io/yaml.h"
#include "plugins/cosserat/laws/joint_terms.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A stem that is stiffer towards one side, as reaction wood makes it: bending about the axis a
// alone, M_a = EI k_a (1 + coefficient k_a / sqrt(k0^2 + k_a^2)). The formula is in
// asymmetry-inl.h.
EffectDefinition define_asymmetry() {
  EffectDefinition d;
  d.name = "asymmetry";
  d.plain_name = "bending that is stiffer towards one side";
  d.sentence =
      "M = EI k (1 + coefficient k / sqrt(k0^2 + k^2)) about an axis: stiffer towards one side";
  d.home = Home::joint;
  d.family = Family::nonlinearity;
  d.parameters = {{.name = "coefficient",
                   // Below 1, so that the moment always grows with the bend: the slope of the added
                   // part is at most 1.09 times the coefficient.
                   .bounds = {-0.9, 0.9},
                   .sentence = "how much stiffer far beyond k0, and softer towards the other side",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.3}},
                  {.name = "axis",
                   .sentence = "about which it bends, in the world as drawn",
                   .size = 3,
                   .role = Role::shape,
                   .first = {1.0, 0.0, 0.0}},
                  {.name = "k0",
                   .unit = "1/m",
                   .bounds = io::positive,
                   // Far below k0 the law is linear, and has no kink at zero: Newton's method needs
                   // its slope there.
                   .sentence = "curvature from which on the sides differ",
                   .role = Role::shape,
                   .first = {1.0}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    if (effect.numbers.contains("axis") && Vec3(effect.numbers.at("axis").data()).isZero(0.0))
      node.error("asymmetry has an axis of length 0, expected a direction [x, y, z]");
  };
  d.change = ModelChange{Stage::laws, [](ModelTarget& t) {
                           // In the world as drawn, since people see a side of a plant and not a
                           // frame of a joint.
                           const Vec3 axis = t.vector("axis").normalized();
                           bool twice = false;
                           t.each_law([&](int e, cosserat::JointLaw& law) {
                             twice = twice || law.term("asymmetry") != 0.0;
                             // Into the element's own axes, which turn with the stem.
                             const Vec3 in_frame =
                                 t.model.elements[e].drawn_rotation.conjugate() * axis;
                             law.term("asymmetry", 0) = t.number("coefficient");
                             law.term("asymmetry", 1) = in_frame.x();
                             law.term("asymmetry", 2) = in_frame.y();
                             // A joint knows a bend in radians. Curvature times the length it
                             // stands for makes the law the same on every mesh.
                             law.term("asymmetry", 3) = t.number("k0") * t.joint_length(e);
                           });
                           // The formula has room for one axis a joint.
                           if (twice) t.error("asymmetry twice on one curve, expected it once");
                         }};
  d.starts = [](const StartContext& c) {
    // Either way about an axis is a coefficient of either sign.
    std::vector<Start> starts;
    for (int i = 0; i < 4; ++i)
      starts.push_back(Start("asymmetry")
                           .signed_number("coefficient", 0.2, 0.3, -0.9, 0.9)
                           .heading("axis", 0.5 * i * std::numbers::pi)
                           .fixed("k0", {c.scales.curvature}));
    return starts;
  };
  d.speaks_for = {{"frequency_by_amplitude", 4}, {"out_of_plane", 5}};
  // Whatever is even in the bend does the same on both sides.
  d.tells_apart = "push as far to one side as to the other";
  return d;
}

}  // namespace pedicel::effects
