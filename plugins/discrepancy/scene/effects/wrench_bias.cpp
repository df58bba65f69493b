#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_wrench_bias() {
  SceneEffectDefinition d;
  d.name = "wrench_bias";
  d.plain_name = "a wrench sensor whose zero is off";
  d.sentence = "a wrench sensor has a constant bias";
  d.home = SceneHome::wrench;
  d.is_only_seen = true;
  d.parameters = {vector_of("force", "N", "in the sensor's frame"),
                  vector_of("moment", "N m", "in the sensor's frame", false),
                  which("wrench", "sensor")};
  d.apply = [](const SceneEffectTarget& t) {
    t.each_gauge([&](SceneState::Gauge& gauge) {
      gauge.force += t.vector("force");
      if (t.has("moment")) gauge.moment += t.vector("moment");
    });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const WrenchSensor& sensor : c.experiment.wrenches) {
      effects::Start start("wrench_bias");
      if (c.experiment.wrenches.size() > 1) start.word("wrench", sensor.name);
      starts.push_back(start.vector("force", Vec3::Zero(), 0.05, 100.0)
                           .vector("moment", Vec3::Zero(), 5.0e-3, 10.0));
    }
    return starts;
  };
  d.speaks_for = {{"wrench_at_rest", 1}, {"moment_at_rest", 1}};
  d.tells_apart = "read the sensor while nothing touches the tool, in several orientations";
  return d;
}

}  // namespace pedicel::discrepancy
