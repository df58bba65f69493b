#include "plugins/effects/decaying_moment.h"

namespace pedicel::effects {

// Slow creep: relaxation (relaxation.cpp) with a time longer than the trials.
EffectDefinition define_creep() {
  EffectDefinition d;
  d.name = "creep";
  d.plain_name = "slow creep";
  d.sentence = "relaxation, far slower than a trial";
  d.home = Home::joint;
  d.family = Family::memory;
  // The same law as relaxation, and a name of its own: within a trial the one has come to its end,
  // and the other has only begun. Advice and tests differ.
  d.parameters = decaying_parameters();
  d.change = ModelChange{Stage::laws, add_decaying_moment};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const double longest = c.scales.duration;
    // From which shape the decay counts is a word, and words are not fitted: each is tried.
    for (const char* from : {"settled", "unloaded", "hung"})
      starts.push_back(Start("creep")
                           .word("start", from)
                           .positive("fraction", 0.2, 1e-3, 0.95)
                           // Never shorter than the longest trial, where relaxation takes over.
                           // Beyond fifty trials only fraction over time is seen.
                           .positive("time", 2.0 * longest, longest, 50.0 * longest));
    return starts;
  };
  d.speaks_for = {{"force_drift", 2},
                  {"clock_trend", 2},
                  {"dynamic_over_static", 2, "fraction", decayed_by_stiffness},
                  {"drive_history", 2, "fraction", decayed_by_history}};
  d.tells_apart = "hold a load for ten minutes, and watch the recovery for as long";
  // A fit that ends at the lower bound says relaxation, and is not told as a second cause.
  d.limits = {{"time", false, "relaxation"}};
  return d;
}

}  // namespace pedicel::effects
