#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_robot_latency() {
  SceneEffectDefinition d;
  d.name = "robot_latency";
  d.plain_name = "an arm's log that comes late";
  d.sentence = "the arm's log is behind the other instruments";
  d.home = SceneHome::arm;
  d.parameters = {
      {.name = "delay",
       .unit = "s",
       .bounds = io::any_number,
       .sentence = "a row at t holds what was at t - delay",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
  };
  d.apply = [](const SceneEffectTarget& t) { t.state.robot_delay += t.number("delay"); };
  d.starts = [](const SceneStartContext&) -> std::vector<effects::Start> {
    return {effects::Start("robot_latency").signed_number("delay", 0.005, 0.005, -0.5, 0.5)};
  };
  d.speaks_for = {{"touch_onset", 3}, {"touch_end", 3}, {"robot_lag", 1}};
  d.tells_apart = "move the arm to and fro with a marker on it";
  return d;
}

}  // namespace pedicel::discrepancy
