#include "engine/geometry/mass_properties.h"

#include <cmath>
#include <string>

#include "engine/core/check.h"
#include "engine/geometry/aabb.h"
#include "engine/geometry/mesh_topology.h"

namespace pedicel::geometry {

std::optional<MassProperties> mass_properties(const TriangleMesh& mesh, double density) {
  if (!(density > 0.0) || !std::isfinite(density))
    throw UsageError("density = " + std::to_string(density) + " kg/m3: must be > 0");
  const TriangleMesh closed = close_holes(mesh);
  const Aabb box = bounds(closed);
  const Vec3 reference = box.center();  // near the body: large coordinates would cancel
  double volume = 0.0;
  Vec3 first = Vec3::Zero();   // integral of r
  Mat3 second = Mat3::Zero();  // integral of r r^T
  for (const auto& triangle : closed.triangles) {
    const Vec3 a = closed.vertices[triangle[0]] - reference;
    const Vec3 b = closed.vertices[triangle[1]] - reference;
    const Vec3 c = closed.vertices[triangle[2]] - reference;
    const double v = a.dot(b.cross(c)) / 6.0;
    const Vec3 sum = a + b + c;
    volume += v;
    first += v / 4.0 * sum;
    second += v / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(std::abs(volume) > 1e-9 * std::pow(box.diagonal().norm(), 3))) return std::nullopt;

  const double turn = volume < 0.0 ? -1.0 : 1.0;
  MassProperties result;
  result.volume = turn * volume;
  result.mass = density * result.volume;
  const Vec3 offset = first / volume;
  result.centre = reference + offset;
  const Mat3 central = turn * density * second - result.mass * offset * offset.transpose();
  result.inertia = central.trace() * Mat3::Identity() - central;
  return result;
}

}  // namespace pedicel::geometry
