#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Young's modulus of everything, as a factor on what the file says; part of every baseline.
EffectDefinition define_youngs_modulus() {
  EffectDefinition d;
  d.name = "youngs_modulus";
  d.plain_name = "another modulus";
  d.sentence = "multiplies Young's modulus of the plant";
  // A factor on all, so that curves with moduli of their own keep their ratios.
  d.home = Home::material;
  d.parameters = {{.name = "factor",
                   .bounds = io::positive,
                   .sentence = "on the nominal value",
                   .vanishes = Vanishes::at_one,
                   .first = {0.9}}};
  d.change = ModelChange{Stage::constants, [](ModelTarget& t) {
                           for (cosserat::Element& element : t.model.elements) {
                             // Shear and twist with it: a modulus of shear is Young's over 2 (1 +
                             // nu), and the file states Poisson's ratio nu apart.
                             element.stretch_stiffness *= t.number("factor");
                             element.bend_stiffness *= t.number("factor");
                           }
                         }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // The prior is wide; it only keeps apart what some data leave entirely open (a free vibration
    // sees modulus over density alone).
    // Moduli of living stems are known to a factor of ten.
    return {Start("youngs_modulus").positive("factor", 1.0, 1.0 / 10.0, 10.0).prior(1.5, 1.0)};
  };
  d.speaks_for = {{"frequency", 1}, {"force_scale", 2}};
  // For the verdict, which tells the factor in pascals where the plant has one modulus.
  d.material = &plant::material_key(plant::MaterialRole::stiffness);
  d.less = "softer";
  d.more = "stiffer";
  return d;
}

}  // namespace pedicel::effects
