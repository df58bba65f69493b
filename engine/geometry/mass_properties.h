#pragma once

#include <optional>

#include "engine/geometry/mesh.h"

namespace pedicel::geometry {

struct MassProperties {
  double volume = 0.0;          ///< m3
  double mass = 0.0;            ///< kg
  Vec3 centre = Vec3::Zero();   ///< m, in the mesh's frame
  Mat3 inertia = Mat3::Zero();  ///< kg m2, about the centre, along the mesh's axes
};

/// The solid of even density (kg/m3) inside a mesh: sums over the tetrahedra between a reference
/// point and each triangle (divergence theorem; F. Tonon, J. Math. Stat. 1, 2005). Holes are closed
/// first (close_holes), a mesh that is inside out is turned. Parts that overlap count twice.
/// Nothing where the mesh holds no volume (a flat sheet). A density that is not positive is a
/// UsageError.
std::optional<MassProperties> mass_properties(const TriangleMesh& mesh, double density);

}  // namespace pedicel::geometry
