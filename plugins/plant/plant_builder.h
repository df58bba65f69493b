#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plugins/cosserat/model/rod_model.h"
#include "plugins/cosserat/solver/standing.h"
#include "plugins/plant/leaf_template.h"
#include "plugins/plant/model/rod_places.h"
#include "plugins/plant/plant_file.h"
#include "plugins/plant/plant_graph.h"

namespace pedicel::plant {

/// A plant ready for the solver, with what is needed to find places on it again.
struct BuiltPlant : RodPlaces {
  cosserat::RodModel model;
  std::vector<BladeTriangle> blades;  ///< leaves, for drawing
  int nodes_sampled = 0;              ///< before simplification
  int nodes_kept = 0;
  double length_drawn = 0.0;  ///< m, of all curves
  double length_kept = 0.0;   ///< m, of the stems' elements
  /// How far it settles from the drawn shape, where that is how it hangs (without effects).
  std::optional<cosserat::Residual> residual;
};

struct BuildOptions {
  Pose pose;                                        ///< X_WP
  Vec3 gravity = Vec3(0, 0, -9.81);                 ///< m/s2
  std::vector<std::filesystem::path> leaf_folders;  ///< of NAME.leaf.yaml, after the plant's own
  /// m, of a short segment below every junction; 0: none. A branch turns with the segment that it
  /// is joined to, whose half below the junction bends under what the other branch carries, too.
  /// Without a short one that is left out, and the branch's place converges with the first power of
  /// the node distance only.
  double junction = 0.0;
};

/// "settles 0.002 mm from its drawing at tomato/leaf_1, 0.0005 mm rms"; empty where it has no
/// residual.
std::string residual_text(const BuiltPlant& plant);

/// Curves to rods: samples, joins, simplifies, adds an element a kept node with the section of its
/// curve at its middle, then masses, fruits, leaves, supports and effects; where `shape: drawn`,
/// the rest shape is found with which the plant stands as drawn (without effects). Faults go to
/// `diagnostics` with the place in the plant file, and then nothing comes back.
std::optional<BuiltPlant> build_plant(const PlantFile& plant, const BuildOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace pedicel::plant
