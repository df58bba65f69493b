#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Time of the Kelvin-Voigt damping, as a factor on what the file says; part of every baseline.
EffectDefinition define_damping_time() {
  EffectDefinition d;
  d.name = "damping_time";
  d.plain_name = "another internal damping";
  d.sentence = "multiplies the damping time of the plant";
  // A factor and no value in seconds, since curves may have their own, and keep their ratios.
  d.home = Home::material;
  d.parameters = {{.name = "factor",
                   .bounds = io::positive,
                   .sentence = "on the nominal value",
                   .vanishes = Vanishes::at_one,
                   .first = {1.0}}};
  // Of every element, leaves included: the time is the material's.
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           for (cosserat::Element& element : t.model.elements)
                             element.damping_time *= t.number("factor");
                         }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // The prior is wide; it only keeps apart what some data leave entirely open (a free vibration
    // sees modulus over density alone).
    // Bounds far wider than those of the modulus, since damping is what is known least of a plant.
    return {Start("damping_time").positive("factor", 1.0, 1.0 / 300.0, 300.0).prior(1.5, 1.0)};
  };
  d.speaks_for = {{"damping", 1}, {"loop_area_by_rate", 1}};
  d.material = &plant::material_key(plant::MaterialRole::damping);
  // For the sentence of a verdict, which says what a factor means.
  d.less = "less damped";
  d.more = "more damped";
  return d;
}

}  // namespace pedicel::effects
