#include "engine/render/mesh_normals.h"

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

bool is_closed(const geometry::TriangleMesh& mesh) {
  std::map<std::tuple<double, double, double>, int> places;
  std::vector<int> place_of;
  for (const Vec3& p : mesh.vertices)
    place_of.push_back(
        places.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(places.size())).first->second);
  std::map<std::pair<int, int>, int> edges;
  double volume = 0.0;
  for (const auto& triangle : mesh.triangles) {
    int corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = place_of[static_cast<std::size_t>(triangle[k])];
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    for (int k = 0; k < 3; ++k) ++edges[{corner[k], corner[(k + 1) % 3]}];
    volume += mesh.vertices[triangle[0]].dot(
        mesh.vertices[triangle[1]].cross(mesh.vertices[triangle[2]]));
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end()) return false;
  }
  return volume > 0.0;
}

}  // namespace pedicel::render
