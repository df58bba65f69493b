#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A grip that slips along the stem, once.
EffectDefinition define_grip_slip() {
  EffectDefinition d;
  d.name = "grip_slip";
  d.plain_name = "a grip that slipped";
  d.sentence = "a hold slips along the stem once";
  d.file = EffectFile::experiment;
  d.home = Home::grip;
  d.family = Family::grip;
  // Of either sign: it slips towards the tip or towards the root.
  d.parameters = {{.name = "distance",
                   .unit = "m",
                   // Along the curve only. What slips off sideways is no hold any more.
                   .sentence = "how much farther along its curve the held point is",
                   .vanishes = Vanishes::at_zero},
                  {.name = "time",
                   .unit = "s",
                   .bounds = io::not_negative,
                   .sentence = "from when on",
                   // A moment, which a fit knows to a step at best. Intervals are widened by that.
                   .role = Role::time,
                   .first = {10.0}}};
  // One slip at one time: friction lets go at once, and holds again. What slips all along is
  // contact.
  d.change = GripChange{[](const plant::Effect& effect, GripState& grip) {
    grip.slip_distance = effect.number("distance");
    grip.slip_time = effect.number("time");
  }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // In the trial of that name (empty: in all), before `end`.
    // In each trial by itself, and in all: a pad that is worn slips every time.
    const auto add = [&](const std::string& trial, double end) {
      // A time has a valley as wide as what the plant still does after it. So starts are spread
      // over the hold.
      for (const double part : {0.1, 0.25, 0.4, 0.55, 0.7, 0.85}) {
        Start start("grip_slip");
        // A word cannot be moved by a fit, so each trial is a start.
        if (!trial.empty()) start.word("trial", trial);
        start.signed_number("distance", 0.01, 0.01, -0.1, 0.1)
            .signed_number("time", part * end, 0.2 * end, 0.0, end);
        starts.push_back(start);
      }
    };
    if (c.holds.empty()) return starts;
    double first_end = 1e300;
    // In all trials alike it can only be before the first of them lets go.
    for (const StartContext::Hold& hold : c.holds) first_end = std::min(first_end, hold.end);
    add("", first_end);
    for (const StartContext::Hold& hold : c.holds) add(hold.trial, hold.end);
    return starts;
  };
  d.speaks_for = {{"loop_area", 4}, {"force_drift", 3}, {"constant_offset", 4}};
  d.tells_apart = "put a marker on the pad of the gripper";
  return d;
}

}  // namespace pedicel::effects
