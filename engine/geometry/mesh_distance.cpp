#include "engine/geometry/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/core/stop.h"

namespace pedicel::geometry {

namespace {

/// Closed, and outward as a whole.
TriangleMesh prepared(TriangleMesh mesh, const MeshTopology& given) {
  if (!given.closed()) mesh = close_holes(mesh);
  const Vec3 reference = bounds(mesh).center();
  double volume = 0.0;
  for (const auto& t : mesh.triangles)
    volume += (mesh.vertices[t[0]] - reference)
                  .dot((mesh.vertices[t[1]] - reference).cross(mesh.vertices[t[2]] - reference));
  if (volume < 0.0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh)
    : given_topology_(topology(mesh)),
      mesh_(prepared(std::move(mesh), given_topology_)),
      bvh_(mesh_),
      by_pseudonormal_(given_topology_.manifold()) {
  set_normals();
}

void MeshDistance::set_normals() {
  normals_.resize(mesh_.triangles.size());
  vertex_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
  std::map<std::pair<int, int>, Vec3> edges;
  const auto edge = [&](const std::array<int, 3>& t, int k) -> Vec3& {
    return edges.try_emplace(std::minmax(t[k], t[(k + 1) % 3]), Vec3::Zero()).first->second;
  };
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    throw_if_stopped();
    const auto& t = mesh_.triangles[i];
    const Vec3 corners[] = {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
    const Vec3 normal =
        unit_or((corners[1] - corners[0]).cross(corners[2] - corners[0]), Vec3::Zero());
    normals_[i].face = normal;
    if (normal.isZero()) by_pseudonormal_ = false;  // no area: its sides' normals are wrong
    for (int k = 0; k < 3; ++k) {
      edge(t, k) += normal;
      vertex_normals_[t[k]] += normal * angle_between(corners[(k + 1) % 3] - corners[k],
                                                      corners[(k + 2) % 3] - corners[k]);
    }
  }
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) normals_[i].edges[k] = edge(mesh_.triangles[i], k);
}

const Vec3& MeshDistance::pseudonormal(const TriangleBvh::Nearest& nearest) const {
  const TriangleNormals& normals = normals_[nearest.triangle];
  const auto& corners = mesh_.triangles[nearest.triangle];
  switch (nearest.at.feature) {
    case TriangleFeature::edge_ab:
      return normals.edges[0];
    case TriangleFeature::edge_bc:
      return normals.edges[1];
    case TriangleFeature::edge_ca:
      return normals.edges[2];
    case TriangleFeature::vertex_a:
      return vertex_normals_[corners[0]];
    case TriangleFeature::vertex_b:
      return vertex_normals_[corners[1]];
    case TriangleFeature::vertex_c:
      return vertex_normals_[corners[2]];
    case TriangleFeature::face:
      break;
  }
  return normals.face;
}

bool MeshDistance::inside(const Vec3& p_L, const TriangleBvh::Nearest& nearest) const {
  if (by_pseudonormal_) return (p_L - nearest.at.point).dot(pseudonormal(nearest)) < 0.0;
  return bvh_.bounds().contains(p_L) && std::abs(bvh_.winding_number(p_L)) > 0.5;
}

double MeshDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  if (!p_L.allFinite()) {  // a simulation that came apart: no nearest point, no abort
    if (gradient_L) *gradient_L = Vec3::UnitZ();
    return std::numeric_limits<double>::quiet_NaN();
  }
  const TriangleBvh::Nearest nearest = bvh_.nearest(p_L);
  const double unsigned_distance = std::sqrt(nearest.squared_distance);
  const double sign = inside(p_L, nearest) ? -1.0 : 1.0;
  if (gradient_L) {
    // On the surface itself the offset is rounding noise, the normal is not.
    const double noise = 1e-13 * (1.0 + p_L.norm());
    const Vec3 normal = unit_or(pseudonormal(nearest), Vec3::UnitZ());
    *gradient_L = unsigned_distance > noise
                      ? Vec3(sign / unsigned_distance * (p_L - nearest.at.point))
                      : normal;
  }
  return sign * unsigned_distance;
}

}  // namespace pedicel::geometry
