#include <algorithm>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_contact_compliance() {
  SceneEffectDefinition d;
  d.name = "contact_compliance";
  d.plain_name = "a soft contact";
  d.sentence = "pad and tissue give way where they touch";
  d.home = SceneHome::contact;
  d.parameters = {
      {.name = "stiffness",
       .unit = "N/m",
       .bounds = io::positive,
       .sentence = "of pad and tissue, in place of the scene's",
       .vanishes = effects::Vanishes::at_infinity,
       .first = {1000.0}},
  };
  d.apply = [](const SceneEffectTarget& t) {
    t.state.coupling.contact_stiffness = t.number("stiffness");
    t.state.coupling.fruit_stiffness = t.number("stiffness");
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    const double own = nominal_state(c.experiment).coupling.contact_stiffness;
    std::vector<effects::Start> starts;
    for (const double share : {400.0, 3.0e3, 3.0e4})
      starts.push_back(effects::Start("contact_compliance")
                           .positive("stiffness", std::min(share, own), 50.0, own));
    return starts;
  };
  d.tells_apart = "press a part of the plant that is held from behind";
  return d;
}

}  // namespace pedicel::discrepancy
