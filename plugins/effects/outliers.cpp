#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Samples that are wrong: found in the data before any physics, and left out.
EffectDefinition define_outliers() {
  EffectDefinition d;
  d.name = "outliers";
  d.plain_name = "samples that are wrong";
  d.sentence = "single samples are wrong";
  d.file = EffectFile::experiment;
  // They are found in the data and left out before anything is fitted, each by itself against its
  // neighbours.
  d.home = Home::sensor;
  d.parameters = {{.name = "fraction",
                   .bounds = io::fraction,
                   .sentence = "of the samples lies far off",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.2}}};
  // Without starts and without a change: no simulation makes them. It is a definition all the same,
  // so that verdicts and the manual know its name and unit.
  d.speaks_for = {{"bad_channel", 2}};
  return d;
}

}  // namespace pedicel::effects
