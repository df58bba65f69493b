#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A stiffness that drifts with the clock: E (1 + rate t), of the whole plant.
EffectDefinition define_stiffness_drift() {
  EffectDefinition d;
  d.name = "stiffness_drift";
  d.plain_name = "a stiffness that drifts with the clock";
  d.sentence = "E times 1 + rate (clock + t), of the whole plant";
  // Of the whole plant and over the clock of the experiment: what dries or warms does so
  // everywhere, and between trials, too.
  d.home = Home::whole;
  d.parameters = {{.name = "rate",
                   .unit = "1/s",
                   .sentence = "of the modulus over clock time",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.5}}};
  // A number of the model, since stiffness changes within a trial. The solver holds it above 0.01.
  d.change =
      ModelChange{Stage::laws, [](ModelTarget& t) { t.model.stiffness_drift += t.number("rate"); }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // Over the whole experiment it changes by 5 %, and by less than all of it: -0.9 is the bound.
    const double longest = std::max(c.clock_span, c.scales.duration);
    // What dries gets stiffer, and what tires gets softer.
    for (const double change : {0.05, -0.05})
      starts.push_back(Start("stiffness_drift")
                           .signed_number("rate", change / longest, 0.1 / longest, -0.9 / longest,
                                          5.0 / longest));
    return starts;
  };
  // In per cent, from the first trial to the last.
  d.speaks_for = {{"clock_trend", 1, "rate", [](double percent, const StartContext& c) {
                     return 0.01 * percent / std::max(c.clock_span, c.scales.duration);
                   }}};
  // Nothing but the clock is then another one.
  d.tells_apart = "repeat the first trial at the end";
  return d;
}

}  // namespace pedicel::effects
