#include "engine/render/unit_meshes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "engine/core/frames.h"
#include "engine/render/mesh_normals.h"

namespace pedicel::render {

namespace {

// Locations and meanings: the vertex stages in shaders.cpp.
constexpr int tube_base[] = {4};
constexpr int tube_instance[] = {4, 4, 3, 3, 3, 3, 3, 3, 3};
constexpr int sphere_base[] = {3};
constexpr int sphere_instance[] = {4, 3, 3};
constexpr int mesh_base[] = {3, 3};
constexpr int mesh_instance[] = {4, 4, 4, 3, 3};
constexpr int blade_base[] = {3};
constexpr int blade_instance[] = {3, 3, 3, 3, 3};
constexpr int line_base[] = {2};
constexpr int line_instance[] = {3, 3, 4};

MeshData unit_cube() {
  geometry::TriangleMesh cube;
  for (int i = 0; i < 8; ++i)
    cube.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return with_normals(cube);
}

}  // namespace

VertexLayout mesh_layout() {
  return {mesh_base, mesh_instance};
}

MeshData unit_sphere(int times) {
  std::vector<Vec3> points = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                              -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  std::vector<std::array<std::uint32_t, 3>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int round = 0; round < times; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto next = static_cast<std::uint32_t>(points.size());
      const auto [found, added] = middles.try_emplace(std::minmax(a, b), next);
      if (added) points.push_back((points[a] + points[b]).normalized());
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  MeshData data;
  for (const Vec3& p : points)
    for (int i = 0; i < 3; ++i) data.vertices.push_back(static_cast<float>(p[i]));
  for (const auto& face : faces) data.indices.insert(data.indices.end(), face.begin(), face.end());
  return data;
}

MeshData unit_tube(int sides, int stretches, int caps) {
  std::vector<std::pair<float, float>> rings;  // along, towards the pole
  for (int i = caps; i > 0; --i) rings.emplace_back(0.0f, -static_cast<float>(i) / caps);
  for (int i = 0; i <= stretches; ++i) rings.emplace_back(static_cast<float>(i) / stretches, 0.0f);
  for (int i = 1; i <= caps; ++i) rings.emplace_back(1.0f, static_cast<float>(i) / caps);
  MeshData data;
  for (const auto& [along, pole] : rings)
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      data.vertices.insert(data.vertices.end(), {along, pole, static_cast<float>(std::cos(angle)),
                                                 static_cast<float>(std::sin(angle))});
    }
  for (std::uint32_t ring = 0; ring + 1 < rings.size(); ++ring)
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(sides); ++k) {
      const std::uint32_t a = ring * sides + k, b = ring * sides + (k + 1) % sides;
      const std::uint32_t c = a + sides, d = b + sides;
      data.indices.insert(data.indices.end(), {a, b, c, b, d, c});
    }
  return data;
}

UnitMeshes::UnitMeshes(const GlFunctions& gl) {
  constexpr int sides[levels] = {6, 10, 18, 32};
  constexpr int stretches[levels] = {2, 3, 5, 8};
  constexpr int caps[levels] = {1, 3, 6, 10};
  constexpr int splits[levels] = {1, 2, 3, 4};
  const auto make = [&](const MeshData& data, std::span<const int> base,
                        std::span<const int> instance) {
    return std::make_unique<InstancedMesh>(gl, data, VertexLayout{base, instance});
  };
  for (int i = 0; i < levels; ++i) {
    tubes_[0][i] = make(unit_tube(sides[i], 1, 0), tube_base, tube_instance);
    tubes_[1][i] = make(unit_tube(sides[i], stretches[i], 0), tube_base, tube_instance);
    capsules_[0][i] = make(unit_tube(sides[i], 1, caps[i]), tube_base, tube_instance);
    capsules_[1][i] = make(unit_tube(sides[i], stretches[i], caps[i]), tube_base, tube_instance);
    spheres_[i] = make(unit_sphere(splits[i]), sphere_base, sphere_instance);
  }
  cube_ = make(unit_cube(), mesh_base, mesh_instance);
  blade_ = make({{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2}}, blade_base, blade_instance);
  line_ = make({{0, -1, 1, -1, 0, 1, 1, 1}, {0, 1, 2, 1, 3, 2}}, line_base, line_instance);
}

int UnitMeshes::level_for(double radius_px) {
  if (radius_px < 2.5) return 0;
  if (radius_px < 12.0) return 1;
  return radius_px < 60.0 ? 2 : 3;
}

}  // namespace pedicel::render
