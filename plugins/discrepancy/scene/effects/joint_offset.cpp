#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_joint_offset() {
  SceneEffectDefinition d;
  d.name = "joint_offset";
  d.plain_name = "an encoder whose zero is off";
  d.sentence = "an encoder's zero is off: the link stands at the reading plus the offset";
  d.home = SceneHome::arm;
  d.parameters = {
      {.name = "offset",
       .unit = "rad",
       .bounds = io::any_number,
       .sentence = "link less reading; m for a sliding joint",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
      {.name = "joint", .sentence = "which joint", .size = 0},
  };
  d.apply = [](const SceneEffectTarget& t) {
    if (const int joint = t.joint(); joint >= 0) t.state.joint_offset[joint] += t.number("offset");
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const std::string& joint : joint_names(c.experiment.robot))
      starts.push_back(effects::Start("joint_offset")
                           .word("joint", joint)
                           .signed_number("offset", 0.0, 2.0e-3, -0.2, 0.2));
    return starts;
  };
  d.speaks_for = {{"touch_onset", 4}, {"touch_end", 4}};
  d.tells_apart = "drive the joint against its stop, or level the link, and read the encoder";
  return d;
}

}  // namespace pedicel::discrepancy
