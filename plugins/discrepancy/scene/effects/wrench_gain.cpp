#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_wrench_gain() {
  SceneEffectDefinition d;
  d.name = "wrench_gain";
  d.plain_name = "a wrench sensor with a wrong gain";
  d.sentence = "a wrench sensor reads a multiple of what acts";
  d.home = SceneHome::wrench;
  d.is_only_seen = true;
  d.parameters = {factor_of("gain", "on force and moment"), which("wrench", "sensor")};
  d.apply = [](const SceneEffectTarget& t) {
    t.each_gauge([&](SceneState::Gauge& gauge) { gauge.gain *= t.number("gain"); });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const WrenchSensor& sensor : c.experiment.wrenches) {
      effects::Start start("wrench_gain");
      if (c.experiment.wrenches.size() > 1) start.word("wrench", sensor.name);
      starts.push_back(start.positive("gain", 1.0, 0.1, 10.0));
    }
    return starts;
  };
  d.speaks_for = {{"friction_ratio", 2}, {"wrench_at_rest", 3}};
  d.tells_apart = "hang a known weight on the tool";
  return d;
}

}  // namespace pedicel::discrepancy
