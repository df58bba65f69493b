#include "engine/geometry/primitives_mesh.h"

#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/check.h"

namespace pedicel::geometry {

namespace {

void check_positive(const char* name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw UsageError(std::string(name) + " = " + std::to_string(value) + " m: must be > 0");
}

void check_segments(int segments) {
  if (segments < 3) throw UsageError("segments = " + std::to_string(segments) + ": must be >= 3");
}

struct Ring {
  double radius, z;
};

/// Turns a profile, listed from the lower to the upper pole and given without the poles, about z.
TriangleMesh revolve(const std::vector<Ring>& rings, double bottom, double top, int segments) {
  TriangleMesh mesh;
  for (const Ring& ring : rings) {
    for (int j = 0; j < segments; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / segments;
      mesh.vertices.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle),
                                 ring.z);
    }
  }
  const int lower_pole = static_cast<int>(mesh.vertices.size()), upper_pole = lower_pole + 1;
  mesh.vertices.emplace_back(0.0, 0.0, bottom);
  mesh.vertices.emplace_back(0.0, 0.0, top);
  const int last = lower_pole - segments;  // the uppermost ring's first vertex
  for (int j = 0; j < segments; ++j) {
    const int next = (j + 1) % segments;
    mesh.triangles.push_back({lower_pole, next, j});
    for (int ring = 0; ring < last; ring += segments) {
      mesh.triangles.push_back({ring + j, ring + next, ring + segments + next});
      mesh.triangles.push_back({ring + j, ring + segments + next, ring + segments + j});
    }
    mesh.triangles.push_back({upper_pole, last + j, last + next});
  }
  return mesh;
}

/// The rings of a sphere cut at its equator and moved apart by `length` (0: one equator).
std::vector<Ring> round_profile(double radius, double length, int segments) {
  const int quarter = std::max(1, segments / 4);
  std::vector<Ring> rings;
  for (int i = 1 - quarter; i <= 0; ++i) {
    const double latitude = 0.5 * std::numbers::pi * i / quarter;
    rings.push_back({radius * std::cos(latitude), radius * std::sin(latitude) - 0.5 * length});
  }
  const int south = static_cast<int>(rings.size());
  for (int i = length > 0.0 ? south - 1 : south - 2; i >= 0; --i)
    rings.push_back({rings[i].radius, -rings[i].z});
  return rings;
}

}  // namespace

TriangleMesh make_box(const Vec3& size) {
  for (int i = 0; i < 3; ++i) check_positive("size", size[i]);
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(size.x() * ((i & 1) - 0.5), size.y() * ((i >> 1 & 1) - 0.5),
                               size.z() * ((i >> 2 & 1) - 0.5));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh make_cylinder(double radius, double length, int segments) {
  check_positive("radius", radius);
  check_positive("length", length);
  check_segments(segments);
  const double half = 0.5 * length;
  return revolve({{radius, -half}, {radius, half}}, -half, half, segments);
}

TriangleMesh make_sphere(double radius, int segments) {
  check_positive("radius", radius);
  check_segments(segments);
  return revolve(round_profile(radius, 0.0, segments), -radius, radius, segments);
}

TriangleMesh make_capsule(double radius, double length, int segments) {
  check_positive("radius", radius);
  check_positive("length", length);
  check_segments(segments);
  const double pole = 0.5 * length + radius;
  return revolve(round_profile(radius, length, segments), -pole, pole, segments);
}

}  // namespace pedicel::geometry
