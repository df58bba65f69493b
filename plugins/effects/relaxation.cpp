#include "pedicel/effects/decaying_moment.h"

namespace pedicel::effects {

// Stress that relaxes: a dashpot in series with a share of the stiffness (standard linear solid).
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
    for (const char* from : {"settled", "unloaded"})
      for (const double time : {0.02, 0.1, 0.4})
        starts.push_back(Start("relaxation")
                             .word("start", from)
                             .positive("fraction", 0.1, 1e-3, 0.95)
                             .positive("time", time * longest, 1e-3 * longest, longest));
    starts.push_back(Start("relaxation")
                         .word("start", "hung")
                         .positive("fraction", 0.2, 1e-3, 0.95)
                         .positive("time", 0.4 * longest, 1e-3 * longest, longest));
    return starts;
  };
  d.speaks_for = {{"loop_area", 2},
                  {"force_drift", 1},
                  {"dynamic_over_static", 1},
                  {"loop_area_by_rate", 2},
                  {"drive_history", 1}};
  d.tells_apart = "hold a push for minutes, and watch the recovery for as long";
  d.limits = {{"time", true, "creep"}};
  return d;
}

}  // namespace pedicel::effects
