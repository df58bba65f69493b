#include <algorithm>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_contact_friction() {
  SceneEffectDefinition d;
  d.name = "contact_friction";
  d.plain_name = "another friction at the robot";
  d.sentence = "the plant slides on the robot with another Coulomb coefficient";
  d.home = SceneHome::contact;
  d.parameters = {
      {.name = "coefficient",
       .unit = "1",
       .bounds = {0.0, 10.0},
       .sentence = "Coulomb coefficient",
       .required = false,
       .otherwise = "the scene's",
       .vanishes = effects::Vanishes::at_nominal,
       .first = {0.5}},
      {.name = "factor",
       .unit = "1",
       .bounds = {0.0, 100.0},
       .sentence = "on the scene's coefficient",
       .required = false,
       .otherwise = "1",
       .vanishes = effects::Vanishes::at_one,
       .first = {1.0}},
      {.name = "link",
       .sentence = "the link for which it holds alone",
       .size = 0,
       .required = false,
       .otherwise = "all"},
  };
  d.apply = [](const SceneEffectTarget& t) {
    const double factor = t.has("factor") ? t.number("factor") : 1.0;
    const auto changed = [&](double own) {
      return factor * (t.has("coefficient") ? t.number("coefficient") : own);
    };
    if (const int link = t.link(); link >= 0) {
      const auto own = t.state.friction_of_link.find(link);
      t.state.friction_of_link[link] =
          changed(own == t.state.friction_of_link.end() ? t.state.coupling.friction : own->second);
      return;
    }
    t.state.coupling.friction = changed(t.state.coupling.friction);
    for (auto& [link, own] : t.state.friction_of_link) own = changed(own);
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    const double own = nominal_state(c.experiment).coupling.friction;
    std::vector<effects::Start> starts;
    for (const double share : {0.4, 1.6})
      starts.push_back(effects::Start("contact_friction")
                           .positive("coefficient", std::max(0.02, share * own), 0.01, 5.0)
                           .vanishing_at(std::max(0.01, own)));
    return starts;
  };
  d.speaks_for = {{"friction_ratio", 1}, {"slip", 1}, {"force_breaks_off", 2}};
  d.tells_apart =
      "drag the tool along the stem under a steady push, and look when it begins to slide";
  return d;
}

}  // namespace pedicel::discrepancy
