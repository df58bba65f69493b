#include <algorithm>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_tracking_lag() {
  SceneEffectDefinition d;
  d.name = "tracking_lag";
  d.plain_name = "a controller that lags";
  d.sentence = "the position controller follows its commands with a lag of first order";
  d.home = SceneHome::arm;
  d.parameters = {
      {.name = "time",
       .unit = "s",
       .bounds = io::not_negative,
       .sentence = "of the lag",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
  };
  d.apply = [](const SceneEffectTarget& t) { t.state.tracking_lag += t.number("time"); };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    if (std::ranges::none_of(c.experiment.trials,
                             [](const Trial& trial) { return trial.follows_commands; }))
      return {};
    return {effects::Start("tracking_lag").signed_number("time", 0.02, 0.02, 0.0, 2.0)};
  };
  d.tells_apart = "command a ramp, and compare it with the encoders";
  return d;
}

}  // namespace pedicel::discrepancy
