#pragma once

#include <vector>

#include "engine/world/scene.h"
#include "engine/world/sim_world.h"
#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::simulation {

/// The scene's loads on fruits. They act before the plants move, and go with a fruit that comes
/// off.
class SceneLoads : public world::Participant {
 public:
  /// Keeps references to both. A load on a fruit that no plant has is an error.
  SceneLoads(const std::vector<world::SceneLoad>& loads, cosserat::RodSystem& rods,
             Diagnostics& diagnostics);

  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

 private:
  struct FruitLoad {
    const world::SceneLoad* load;
    int plant, fruit;
    std::size_t slot;  // in RodSystem::loads()
  };

  cosserat::RodSystem& rods_;
  std::vector<FruitLoad> loads_;
};

}  // namespace pedicel::simulation
