#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_tool_pose() {
  SceneEffectDefinition d;
  d.name = "tool_pose";
  d.plain_name = "a tool that is mounted elsewhere";
  d.sentence = "the tool sits elsewhere in the link that carries it";
  d.home = SceneHome::arm;
  d.parameters = {vector_of("offset", "m", "in the axes of the carrying link"),
                  vector_of("rotation", "rad", "rotation vector in these axes", false)};
  d.apply = [](const SceneEffectTarget& t) {
    t.state.tool_offset += t.vector("offset");
    if (t.has("rotation")) t.state.tool_rotation += t.vector("rotation");
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    if (!c.experiment.scene.robot) return {};
    return {effects::Start("tool_pose")
                .vector("offset", Vec3::Zero(), 1.0e-3, 0.05)
                .vector("rotation", Vec3::Zero(), 0.01, 0.5)};
  };
  d.speaks_for = {{"touch_onset", 2}, {"touch_end", 2}};
  d.tells_apart = "touch a known point with the tool from two sides";
  return d;
}

}  // namespace pedicel::discrepancy
