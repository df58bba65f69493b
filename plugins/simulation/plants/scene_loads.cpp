#include "plugins/simulation/plants/scene_loads.h"

#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

SceneLoads::SceneLoads(const std::vector<world::SceneLoad>& loads, cosserat::RodSystem& rods,
                       Diagnostics& diagnostics)
    : rods_(rods) {
  for (const world::SceneLoad& load : loads) {
    bool found = false;
    for (int p = 0; p < rods_.size(); ++p) {
      const cosserat::RodModel& model = rods_.model(p);
      for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
        if (fruit_name(model, f) != load.target) continue;
        found = true;
        // The slot in the rods stays, also at zero: what is added later keeps its place.
        loads_.push_back({&load, p, f, rods_.loads(p).size()});
        rods_.loads(p).push_back({model.fruits[f].element, model.fruits[f].back, {}, {}});
        rods_.loads(p).back().force_W.setZero();
        rods_.loads(p).back().moment_W.setZero();
      }
    }
    if (!found)
      diagnostics.error(load.where,
                        "load on \"" + load.target + "\", expected PLANT/FRUIT of this scene");
  }
}

void SceneLoads::act(world::SimWorld& world, world::WorldReport&) {
  const double time = world.time();
  for (const FruitLoad& one : loads_) {
    const world::SceneLoad& load = *one.load;
    // From `from` on and before `to`, so that two loads can follow each other without a gap.
    double share = time >= load.from && time < load.to ? 1.0 : 0.0;
    if (load.ramp) share *= (time - load.from) / (load.to - load.from);
    // What pulled at a fruit does not pull at the stalk that it left.
    if (rods_.state(one.plant).fruit_gone[one.fruit]) share = 0.0;
    rods_.loads(one.plant)[one.slot].force_W = share * load.force;
  }
}

}  // namespace pedicel::simulation
