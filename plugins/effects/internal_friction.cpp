#include "engine/io/yaml.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Friction inside the stem: a slider (Jenkins) that carries a ratio of the stiffness up to a
// moment. The formula is in internal_friction-inl.h.
EffectDefinition define_internal_friction() {
  EffectDefinition d;
  d.name = "internal_friction";
  d.plain_name = "friction inside the stem";
  d.sentence = "a part of the stiffness goes through a slider that slips";
  d.home = Home::joint;
  d.family = Family::memory;
  d.parameters = {{.name = "moment",
                   .unit = "N m",
                   .bounds = io::positive,
                   .sentence = "at which each joint slips",
                   .required = false,
                   // A tapered stem slips first at its thin end by a curvature, and first where the
                   // load's moment is largest by a moment. Data may show either, so both can be
                   // said.
                   .otherwise = "this or the next",
                   .offered = false,
                   .role = Role::shape,
                   .first = {0.01}},
                  {.name = "curvature",
                   .unit = "1/m",
                   .bounds = io::positive,
                   .sentence = "at which it slips",
                   .required = false,
                   .otherwise = "this or the one before",
                   .role = Role::shape,
                   .first = {1.0}},
                  {.name = "ratio",
                   .bounds = io::fraction,
                   .sentence = "part of the stiffness in the slider",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.5}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    const bool moment = effect.numbers.contains("moment");
    // Both or neither.
    if (moment == effect.numbers.contains("curvature"))
      node.error("internal_friction gives " + std::string(moment ? "both" : "neither") +
                 " of moment and curvature, expected one of them");
  };
  d.change = ModelChange{Stage::laws, [](ModelTarget& t) {
                           t.each_law([&](int e, cosserat::JointLaw& law) {
                             const double ratio = t.number("ratio");
                             // As for every law with a memory: a branch that carries nothing still
                             // takes time in each step.
                             if (ratio == 0.0) return;
                             // The slider's own moment at that bend: its share of the joint's
                             // stiffness, by the softer axis, in which bends of both are measured.
                             cosserat::add_friction(law, ratio,
                                                    t.has("moment") ? t.number("moment")
                                                                    : ratio * t.softer_bending(e) *
                                                                          t.number("curvature") *
                                                                          t.joint_length(e));
                           });
                         }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const double k = c.scales.curvature;
    // Below the largest curvature of the trials. A slider that never slips is only stiffness, and
    // has no slope to fit by.
    // How much and how early do nearly the same to a loop's area, so both are tried in pairs.
    for (const double slip : {0.03, 0.1, 0.3})
      for (const double ratio : {0.1, 0.3})
        starts.push_back(Start("internal_friction")
                             .positive("curvature", slip * k, 1e-4 * k, 20 * k)
                             .positive("ratio", ratio, 1e-3, 0.95));
    return starts;
  };
  // Narrow swings do not slip: they are stiffer and less damped than wide ones, but for very wide
  // ones, in which the slider carries little.
  d.speaks_for = {{"loop_area", 1}, {"frequency_by_amplitude", 2}, {"damping_by_amplitude", 2}};
  // Friction costs the same at any rate. What is viscous goes away with the rate.
  d.tells_apart = "push ten times as slowly";
  return d;
}

}  // namespace pedicel::effects
