#include "engine/io/yaml.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Another law of detachment, of every fruit or of those on one curve: scales of the loads, and the
// exponents with which they add up (cosserat/solver/detachment.h).
EffectDefinition define_detachment_law() {
  EffectDefinition d;
  d.name = "detachment_law";
  // One law in place of five thresholds: a stalk that bears both force and bending comes off below
  // either limit, which no set of single thresholds can say.
  d.plain_name = "another law of detachment";
  // It has no starts: when stalks break is fitted to events by maximum likelihood, and not to
  // samples.
  d.sentence = "a law of breaking in place of the thresholds: [theory](theory_detachment.md)";
  d.home = Home::stalk;
  d.parameters = {{.name = "force",
                   .unit = "N",
                   .bounds = io::positive,
                   .sentence = "scale of the force",
                   .required = false,
                   // A scale that is left out is infinite and takes no part, so each of them may
                   // be, but not all.
                   .otherwise = "one of three needed",
                   .role = Role::shape,
                   .first = {5.0}},
                  {.name = "moment",
                   .unit = "N m",
                   .bounds = io::positive,
                   .sentence = "scale of the bending moment",
                   .required = false,
                   .otherwise = "one of three needed",
                   // The window begins with a force alone, which is what people measure by a pull.
                   .offered = false,
                   .role = Role::shape,
                   .first = {0.01}},
                  {.name = "torsion",
                   .unit = "N m",
                   .bounds = io::positive,
                   .sentence = "scale of the torsion",
                   .required = false,
                   .otherwise = "one of three needed",
                   .offered = false,
                   .role = Role::shape,
                   .first = {0.01}},
                  {.name = "exponents",
                   .bounds = io::positive,
                   .sentence = "of force, moment and torsion",
                   .size = 3,
                   .required = false,
                   .otherwise = "`[2, 2, 2]`",
                   .offered = false,
                   .role = Role::shape,
                   // Squares add up as independent directions do. A large exponent goes towards the
                   // plain threshold on the largest ratio.
                   .first = {2.0, 2.0, 2.0}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    const auto gives = [&](const char* name) { return effect.numbers.contains(name); };
    // Without any scale nothing would ever come off, which nobody writes on purpose.
    if (!gives("force") && !gives("moment") && !gives("torsion"))
      node.error(
          "detachment_law gives none of force, moment and torsion, expected at least one of them");
    if (!gives("exponents")) return;
    // With an exponent of zero a term is always 1, and every fruit falls at once.
    for (const double exponent : effect.numbers.at("exponents"))
      if (!(exponent > 0.0))
        node.error("exponents has " + std::to_string(exponent) + ", expected numbers above 0");
  };
  d.speaks_for = {{"detachment", 2}};
  d.change =
      ModelChange{Stage::constants, [](ModelTarget& t) {
                    // Begins with scales of infinity and exponents of 2.
                    cosserat::DetachmentLaw law;
                    const auto set = [&](double& scale, const char* parameter) {
                      // Left out, a scale stays infinite.
                      if (t.has(parameter)) scale = t.number(parameter);
                    };
                    set(law.force, "force");
                    set(law.moment, "moment");
                    set(law.torsion, "torsion");
                    if (t.has("exponents")) {
                      const std::vector<double>& e = t.effect.numbers.at("exponents");
                      law.exponents = {e[0], e[1], e[2]};
                    }
                    // Fruits of the model stand in the order of the file.
                    // A law of a fruit takes the place of its thresholds: the solver looks at one
                    // or at the other.
                    for (std::size_t f = 0; f < t.model.fruits.size(); ++f)
                      if (!t.effect.place || t.plant.fruits[f].place.curve == t.effect.place->curve)
                        t.model.fruits[f].law = law;
                  }};
  return d;
}

}  // namespace pedicel::effects
