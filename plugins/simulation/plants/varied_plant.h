#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "engine/io/bounds.h"
#include "engine/world/scene.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::simulation {

/// In what plants of a grid may differ beside the keys of `set`: its one description.
struct GridKey {
  enum class What { turn, lean, towards, scale, fruits };
  std::string_view key;  ///< "place.turn"
  What what = What::turn;
  std::string_view unit;
  io::Bounds bounds;
};
std::span<const GridKey> grid_keys();

/// Makes of a grid's plant the one with this number (0 is the first): draws what its `vary` says
/// from the run's seed, the entry's name and the number, changes the plant, and turns and leans its
/// pose (X_WP) about the root. So a plant stays what it is where others are added behind it.
/// Unknown keys and impossible values go to `diagnostics`.
void vary_plant(const world::ScenePlant& grid, int number, std::uint64_t seed,
                plant::PlantFile& plant, Pose& pose, Diagnostics& diagnostics);

}  // namespace pedicel::simulation
