#include "pedicel/render/mesh_normals.h"

#include <cmath>
#include <map>
#include <tuple>

namespace pedicel::render {

namespace {

/// Twice the area vector of each triangle.
std::vector<Vec3> area_vectors(const geometry::TriangleMesh& mesh) {
  std::vector<Vec3> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    areas.push_back(
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]));
  return areas;
}

Vec3 unit_or_up(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3::UnitZ();
}

}  // namespace

MeshData with_normals(const geometry::TriangleMesh& mesh, double crease) {
  const std::vector<Vec3> areas = area_vectors(mesh);
  std::vector<std::vector<int>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int vertex : mesh.triangles[t]) around[vertex].push_back(static_cast<int>(t));

  MeshData data;
  std::map<std::tuple<int, float, float, float>, std::uint32_t> known;
  const double least_cosine = std::cos(crease);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 face = unit_or_up(areas[t]);
    for (const int vertex : mesh.triangles[t]) {
      Vec3 sum = Vec3::Zero();
      for (const int other : around[vertex])
        if (unit_or_up(areas[other]).dot(face) >= least_cosine) sum += areas[other];
      const Eigen::Vector3f p = mesh.vertices[vertex].cast<float>();
      const Eigen::Vector3f n = unit_or_up(sum).cast<float>();
      const auto next = static_cast<std::uint32_t>(data.vertices.size() / 6);
      const auto [found, added] = known.try_emplace({vertex, n.x(), n.y(), n.z()}, next);
      if (added)
        data.vertices.insert(data.vertices.end(), {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()});
      data.indices.push_back(found->second);
    }
  }
  return data;
}

}  // namespace pedicel::render
