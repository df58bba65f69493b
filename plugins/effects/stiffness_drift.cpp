#include <algorithm>

#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A stiffness that drifts with the clock: E (1 + rate t), of the whole plant.
EffectDefinition define_stiffness_drift() {
  EffectDefinition d;
  d.name = "stiffness_drift";
  d.plain_name = "a stiffness that drifts with the clock";
  d.sentence = "E times 1 + rate (clock + t), of the whole plant";
  d.home = Home::whole;
  d.parameters = {{.name = "rate",
                   .unit = "1/s",
                   .sentence = "of the modulus over clock time",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.5}}};
  d.change =
      ModelChange{Stage::laws, [](ModelTarget& t) { t.model.stiffness_drift += t.number("rate"); }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const double longest = std::max(c.clock_span, c.scales.duration);
    for (const double change : {0.05, -0.05})
      starts.push_back(Start("stiffness_drift")
                           .signed_number("rate", change / longest, 0.1 / longest, -0.9 / longest,
                                          5.0 / longest));
    return starts;
  };
  d.speaks_for = {{"clock_trend", 1}};
  d.tells_apart = "repeat the first trial at the end";
  return d;
}

}  // namespace pedicel::effects
