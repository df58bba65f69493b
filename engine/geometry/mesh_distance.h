#pragma once

#include "engine/geometry/mesh_topology.h"
#include "engine/geometry/signed_distance.h"
#include "engine/geometry/triangle_bvh.h"

namespace pedicel::geometry {

/// The exact signed distance to a triangle mesh.
///
/// Sign: for a manifold mesh from angle-weighted pseudonormals (J. A. Baerentzen, H. Aanaes, IEEE
/// Trans. Vis. Comput. Graph. 11, 2005). Meshes of real robots are often not watertight, or several
/// parts pushed into each other: then holes are closed first (close_holes, so that the surface has
/// an inside and the distance stays continuous) and a point is inside where the winding number is
/// beyond +-1/2. Surfaces inside of such a body still count as surface: the depth below them is
/// measured to them. A mesh that is inside out as a whole is turned.
class MeshDistance final : public SignedDistance {
 public:
  /// A mesh without triangles is a UsageError.
  explicit MeshDistance(TriangleMesh mesh);

  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override { return bvh_.bounds(); }

  /// What the given mesh was like, before holes were closed.
  const MeshTopology& given_topology() const { return given_topology_; }

  /// The two halves of a distance, for grids: the nearest point within `bound` (m), and whether
  /// p_L, whose nearest point is known, is inside.
  TriangleBvh::Nearest nearest(const Vec3& p_L, double bound) const {
    return bvh_.nearest(p_L, bound);
  }
  bool inside(const Vec3& p_L, const TriangleBvh::Nearest& nearest) const;

 private:
  struct TriangleNormals {
    Vec3 face;      ///< unit
    Vec3 edges[3];  ///< ab, bc, ca: the sum of the neighbours' normals
  };

  void set_normals();
  const Vec3& pseudonormal(const TriangleBvh::Nearest& nearest) const;

  MeshTopology given_topology_;
  TriangleMesh mesh_;  ///< without holes
  TriangleBvh bvh_;
  bool by_pseudonormal_;  ///< else by winding number
  std::vector<TriangleNormals> normals_;
  std::vector<Vec3> vertex_normals_;  ///< angle-weighted, not unit
};

}  // namespace pedicel::geometry
