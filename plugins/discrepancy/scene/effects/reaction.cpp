#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_reaction() {
  SceneEffectDefinition d;
  d.name = "reaction";
  d.plain_name = "an arm that the plant moves";
  d.sentence = "the plant moves the arm: its joints give way between encoder and link";
  d.home = SceneHome::arm;
  d.parameters = {
      {.name = "joint_stiffness",
       .unit = "N m/rad",
       .bounds = io::positive,
       .sentence = "of every joint between encoder and link",
       .vanishes = effects::Vanishes::at_infinity,
       .first = {1000.0}},
  };
  d.apply = [](const SceneEffectTarget& t) {
    const double k = t.number("joint_stiffness"), own = t.state.joint_stiffness;
    t.state.joint_stiffness = own > 0.0 ? own * k / (own + k) : k;
  };
  d.starts = [](const SceneStartContext&) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const double stiffness : {60.0, 400.0, 3000.0})
      starts.push_back(
          effects::Start("reaction").positive("joint_stiffness", stiffness, 5.0, 1.0e5));
    return starts;
  };
  d.tells_apart = "push with the tool against a spring scale, and watch a marker on the tool";
  return d;
}

}  // namespace pedicel::discrepancy
