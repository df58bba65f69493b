#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/cosserat/solver/standing.h"
#include "plugins/plant/plant_file.h"
#include "plugins/simulation/plants/blade.h"

namespace pedicel::simulation {

/// A plant of the simulation and what is known of it beyond its rods.
struct PlantInfo {
  std::string name;           ///< as in the scene; "forest_3" in a grid
  std::vector<Blade> blades;  ///< leaves, for drawing
  plant::Look look = plant::Look::tomato;
  int sampled_nodes = 0;  ///< before simplification; 0: not from curves
  /// How far it settles from the drawn shape, and that in words; absent where it sags freely.
  std::optional<cosserat::Residual> residual;
  std::string residual_text;
};

/// Of the plant that settles farthest from its drawing: residual_text; empty where none is drawn as
/// it hangs.
std::string worst_residual(const std::vector<PlantInfo>& plants);

}  // namespace pedicel::simulation
