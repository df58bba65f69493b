#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/geometry/grid_distance.h"
#include "engine/robot/description.h"

/// How the distance to each collision mesh of a robot is computed: from a grid kept on disk
/// (geometry/grid_cache.h), or, where that would take too much memory and time, exactly near the
/// mesh and from a coarse grid farther away.
namespace pedicel::simulation {

struct MeshField {
  const geometry::TriangleMesh* mesh = nullptr;
  std::string link, file;    ///< the first link that has it
  Vec3 size = Vec3::Zero();  ///< m
  bool exact_near = false;
  geometry::GridSettings grid;
};

/// The most samples of one fine grid (0.5 m cube), of all of a robot's together, and of a coarse
/// one; 4 bytes each.
inline constexpr double most_fine_samples = 0x1p25, most_robot_samples = 0x1p27,
                        most_coarse_samples = 0x1p20;
/// Distance from a surface up to which it must be known well, m: GridSettings::band.
inline constexpr double near_band = 0.01;

/// One for each mesh among a robot's collisions. Nothing is built: what is large is known before.
std::vector<MeshField> plan_mesh_fields(const robot::RobotDescription& robot);

/// One warning for each mesh that is too large for a fine grid: link, mesh, size and error.
std::vector<std::string> large_mesh_warnings(const robot::RobotDescription& robot);

using MeshDistances =
    std::map<const geometry::TriangleMesh*, std::shared_ptr<const geometry::SignedDistance>>;

/// The exact field of each mesh, which needs no grid: for picking and drawing on a robot in a world
/// without plants, where nobody asks for thousands of distances a step.
MeshDistances exact_mesh_fields(const robot::RobotDescription& robot);

/// Builds the field of each mesh, or reads it from the cache. Problems with that, large meshes and,
/// where something was built, the place of the cache are added to `notes`, one sentence each.
MeshDistances build_mesh_fields(const robot::RobotDescription& robot,
                                std::vector<std::string>& notes);

}  // namespace pedicel::simulation
