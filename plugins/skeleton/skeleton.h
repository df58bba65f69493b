#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

/// What a digitised plant does not say.
struct MtgOptions {
  double youngs_modulus = 1.0e9;     ///< Pa
  double poisson_ratio = 0.3;        ///< 1
  double density = 950;              ///< kg/m3
  double damping_time = 0.02;        ///< s
  double connect = 0.02;             ///< m
  double distance = 0.06;            ///< m
  double smallest_diameter = 0.004;  ///< m; thinner and unmeasured wood gets this
  bool keeps_thin = false;           ///< only unmeasured wood gets that
};

/// A digitised place of a plant.
struct SkeletonNode {
  int parent = -1;                 ///< index of a node before this one, -1: the root
  Vec3 position = Vec3::Zero();    ///< m, P
  std::optional<double> diameter;  ///< m
  bool branch = false;  ///< begins a new axis ("+"); else it continues its parent's ("<")
  std::string code;     ///< what the file calls it
  SourcePosition where;
};

/// One linear curve per axis with a radius a point. A branch starts at its parent's point with its
/// own radius; a diameter that is missing is the one before it on the axis, then the one behind it,
/// then the parent's. Points that repeat the one before are left out, and so are axes without an
/// extent: what they carry starts at the same place. The first node is the root; parents stand
/// before their children. It has the look of an apple tree.
PlantFile skeleton_plant(const std::vector<SkeletonNode>& nodes, const std::string& name,
                         const MtgOptions& options);

/// The same with the checks of check_plant(); nothing comes back after an error.
std::optional<PlantFile> checked_skeleton_plant(const std::vector<SkeletonNode>& nodes,
                                                const std::string& name, const MtgOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace pedicel::plant
