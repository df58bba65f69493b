#include <algorithm>

#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A soft grip: the stiffness with which a hold keeps its point.
EffectDefinition define_grip_compliance() {
  EffectDefinition d;
  d.name = "grip_compliance";
  d.plain_name = "a soft grip";
  d.sentence = "a hold keeps its point by a spring";
  d.file = EffectFile::experiment;
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
    grip.stiffness = effect.number("stiffness");
  }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    if (c.holds.empty()) return starts;
    double stated = 0.0;
    for (const StartContext::Hold& hold : c.holds) stated = std::max(stated, hold.stiffness);
    const double soft = c.scales.root_stiffness / (c.scales.length * c.scales.length);
    const double from = stated > 0.0 ? stated : 300.0 * soft;
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
