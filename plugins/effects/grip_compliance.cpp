#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A soft grip: the stiffness with which a hold keeps its point.
EffectDefinition define_grip_compliance() {
  EffectDefinition d;
  d.name = "grip_compliance";
  d.plain_name = "a soft grip";
  d.sentence = "a hold keeps its point by a spring";
  d.file = EffectFile::experiment;
  // It acts on the hold and not on what is read, so the plant gets less of the way that the drive
  // made.
  d.home = Home::grip;
  d.family = Family::grip;
  d.parameters = {
      {.name = "stiffness",
       .unit = "N/m",
       .bounds = io::positive,
       .sentence =
           "spring between the commanded and the held point, in place of what the drive states",
       .vanishes = Vanishes::at_infinity,
       .first = {5.0}}};
  d.change = GripChange{[](const plant::Effect& effect, GripState& grip) {
    // In place of what the drive states and not beside it: two springs in series cannot be told
    // apart by what is measured.
    grip.stiffness = effect.number("stiffness");
  }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // Nothing was held.
    if (c.holds.empty()) return starts;
    // The largest of all trials: one grip is meant, and the others may leave it out.
    double stated = 0.0;
    for (const StartContext::Hold& hold : c.holds) stated = std::max(stated, hold.stiffness);
    // N/m at the tip, up to a number: EI/L over L squared. A grip softer than the plant would not
    // move it.
    const double soft = c.scales.root_stiffness / (c.scales.length * c.scales.length);
    const double from = stated > 0.0 ? stated : 300.0 * soft;
    // Both below what is stated: what is looked for is a grip that is softer. Between them lies a
    // factor of six, which a fit bridges.
    for (const double part : {0.6, 0.1}) {
      starts.push_back(
          Start("grip_compliance").positive("stiffness", part * from, 0.1 * soft, 1e5 * soft));
      // It replaces a stated stiffness; without one the grip is rigid.
      if (stated > 0.0) starts.back().vanishing_at(stated);
    }
    return starts;
  };
  d.speaks_for = {{"force_scale", 4}};
  d.tells_apart = "put a marker on the pad of the gripper, or push a rigid post";
  return d;
}

}  // namespace pedicel::effects
