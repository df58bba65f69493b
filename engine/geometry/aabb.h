#pragma once

#include "engine/geometry/mesh.h"

namespace pedicel::geometry {

/// An axis-aligned box, m: min(), max(), center(), sizes(), extend(), contains(), isEmpty(),
/// exteriorDistance(). Empty when made.
using Aabb = Eigen::AlignedBox3d;

/// The box around the vertices.
inline Aabb bounds(const TriangleMesh& mesh) {
  Aabb box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

}  // namespace pedicel::geometry
