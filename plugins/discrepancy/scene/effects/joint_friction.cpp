#include <algorithm>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_joint_friction() {
  SceneEffectDefinition d;
  d.name = "joint_friction";
  d.plain_name = "friction in the joints of the arm";
  d.sentence = "joints have more friction than their file says";
  d.home = SceneHome::arm;
  d.is_only_seen = true;
  d.parameters = {
      {.name = "coulomb",
       .unit = "N m",
       .bounds = io::not_negative,
       .sentence = "dry friction",
       .required = false,
       .otherwise = "0",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
      {.name = "viscous",
       .unit = "N m s/rad",
       .bounds = io::not_negative,
       .sentence = "damping",
       .required = false,
       .otherwise = "0",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
      {.name = "joint",
       .sentence = "the joint for which it holds alone",
       .size = 0,
       .required = false,
       .otherwise = "all"},
  };
  d.apply = [](const SceneEffectTarget& t) {
    const int joint = t.joint();
    for (int dof = 0; dof < t.state.coulomb.size(); ++dof) {
      if (joint >= 0 && dof != joint) continue;
      if (t.has("coulomb")) t.state.coulomb[dof] += t.number("coulomb");
      if (t.has("viscous")) t.state.viscous[dof] += t.number("viscous");
    }
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    const bool shows = std::ranges::any_of(c.experiment.trials, [](const Trial& trial) {
      return trial.torques.size() > 0 || trial.follows_commands;
    });
    if (!shows) return {};
    const auto with_numbers = [](effects::Start start) {
      return start.signed_number("coulomb", 0.1, 0.1, 0.0, 50.0)
          .signed_number("viscous", 0.1, 0.1, 0.0, 100.0);
    };
    // One joint is worn more often than all are by the same.
    std::vector<effects::Start> starts;
    for (const std::string& joint : joint_names(c.experiment.robot))
      starts.push_back(with_numbers(effects::Start("joint_friction").word("joint", joint)));
    starts.push_back(with_numbers(effects::Start("joint_friction")));
    return starts;
  };
  d.tells_apart = "move one joint at a time, slowly and fast, both ways";
  return d;
}

}  // namespace pedicel::discrepancy
