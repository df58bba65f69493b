#include "plugins/effects/decaying_moment.h"

namespace pedicel::effects {

// Stress that relaxes: a dashpot in series with a share of the stiffness (standard linear solid).
// Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials. Of woody
// branches the fraction is 0.3 to 0.5.
EffectDefinition define_relaxation() {
  EffectDefinition d;
  d.name = "relaxation";
  d.plain_name = "stress that relaxes";
  d.sentence = "a part of the moment decays (standard linear solid)";
  d.home = Home::joint;
  d.family = Family::memory;
  d.parameters = decaying_parameters();
  d.change = ModelChange{Stage::laws, add_decaying_moment};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const double longest = c.scales.duration;
    // `settled`: it has come to rest in its shape before the trial, and only changes relax.
    // `unloaded`: what it bears at the start relaxes, too.
    // Spread over the logarithm, from a fiftieth of the longest trial to nearly a half of it.
    for (const char* from : {"settled", "unloaded"})
      for (const double time : {0.02, 0.1, 0.4})
        starts.push_back(Start("relaxation")
                             .word("start", from)
                             .positive("fraction", 0.1, 1e-3, 0.95)
                             .positive("time", time * longest, 1e-3 * longest, longest));
    // One start for what had hung: it differs by how it answers to the first load, and not by its
    // time.
    starts.push_back(Start("relaxation")
                         .word("start", "hung")
                         .positive("fraction", 0.2, 1e-3, 0.95)
                         .positive("time", 0.4 * longest, 1e-3 * longest, longest));
    return starts;
  };
  d.speaks_for = {{"loop_area", 2},
                  {"force_drift", 1},
                  {"dynamic_over_static", 1, "fraction", decayed_by_stiffness},
                  {"loop_area_by_rate", 2},
                  {"drive_history", 1, "fraction", decayed_by_history}};
  d.tells_apart = "hold a push for minutes, and watch the recovery for as long";
  // With a time as long as the trials it is creep, and is not told beside it.
  d.limits = {{"time", true, "creep"}};
  return d;
}

}  // namespace pedicel::effects
