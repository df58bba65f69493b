#pragma once

#include <optional>

#include "plugins/simulation/simulation.h"

/// Where things of a scene are now.
namespace pedicel::simulation {

/// A fruit that is on its plant no more, as the body that it is or hangs on.
struct FallenFruit {
  int body = -1;                 ///< index into the SimWorld
  Vec3 centre = Vec3::Zero();    ///< m, W
  Vec3 velocity = Vec3::Zero();  ///< m/s, W, of the centre
  bool cut = false;              ///< it fell with the stem that it hangs on
};
std::optional<FallenFruit> fallen_fruit(const Simulation& simulation, int plant, int fruit);

/// Where an anchor is (m, W); nothing where there is no such thing.
std::optional<Vec3> place_of(const Simulation& simulation, const world::Anchor& anchor);

}  // namespace pedicel::simulation
