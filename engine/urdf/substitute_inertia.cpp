#include "engine/urdf/substitute_inertia.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "engine/geometry/mass_properties.h"
#include "engine/io/csv.h"
#include "engine/robot/inertial_sum.h"

namespace pedicel::robot {

namespace {

constexpr double pi = std::numbers::pi;

Inertial box_solid(const Vec3& size, const Vec3& centre, double density) {
  Inertial solid;
  solid.mass = density * size.prod();
  solid.com_L = centre;
  const Vec3 squares = size.cwiseAbs2();
  solid.inertia = (solid.mass / 12.0 * (Vec3::Constant(squares.sum()) - squares)).asDiagonal();
  return solid;
}

Inertial cylinder_solid(double radius, double length, double density) {
  Inertial solid;
  solid.mass = density * pi * radius * radius * length;
  const double across = solid.mass * (3.0 * radius * radius + length * length) / 12.0;
  solid.inertia = Vec3(across, across, 0.5 * solid.mass * radius * radius).asDiagonal();
  return solid;
}

Inertial sphere_solid(double radius, double density) {
  Inertial solid;
  solid.mass = density * 4.0 / 3.0 * pi * radius * radius * radius;
  solid.inertia = Mat3::Identity() * (0.4 * solid.mass * radius * radius);
  return solid;
}

Inertial capsule_solid(double radius, double length, double density) {
  Inertial sum;
  const Inertial middle = cylinder_solid(radius, length, density);
  const Inertial ball = sphere_solid(radius, density);
  const double half = 0.5 * length, reach = 0.375 * radius;  // centre of a half ball's mass
  sum.mass = middle.mass + ball.mass;
  // Both halves about their own centres, then moved out by half the length.
  const double across = ball.inertia(0, 0) + ball.mass * (half * half + 2.0 * half * reach);
  sum.inertia = middle.inertia;
  sum.inertia += Vec3(across, across, ball.inertia(2, 2)).asDiagonal().toDenseMatrix();
  return sum;
}

/// A mesh that holds no volume (a flat sheet) counts as its bounding box, at least 1 mm thick.
Inertial mesh_solid(const geometry::TriangleMesh& mesh, double density) {
  if (const auto properties = geometry::mass_properties(mesh, density))
    return {properties->mass, properties->centre, properties->inertia};
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return box_solid((high - low).cwiseMax(1e-3), 0.5 * (low + high), density);
}

Inertial shape_solid(const Geometry& shape, double density) {
  switch (shape.kind) {
    case Geometry::Kind::box:
      return box_solid(shape.size, Vec3::Zero(), density);
    case Geometry::Kind::cylinder:
      return cylinder_solid(shape.radius, shape.length, density);
    case Geometry::Kind::sphere:
      return sphere_solid(shape.radius, density);
    case Geometry::Kind::capsule:
      return capsule_solid(shape.radius, shape.length, density);
    case Geometry::Kind::mesh:
      break;
  }
  return mesh_solid(*shape.mesh, density);
}

bool positive_definite(const Mat3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() > 1e-12;
}

}  // namespace

std::optional<Inertial> solid_of_geometry(const Link& link, double density) {
  Inertial sum;
  for (const Collision& c : link.collisions)
    add_inertial(sum, shape_solid(c.geometry, density), c.X_LC);
  if (link.collisions.empty())
    for (const Visual& v : link.visuals)
      add_inertial(sum, shape_solid(v.geometry, density), v.X_LV);
  if (sum.mass > 0.0) return sum;
  return {};
}

std::string InertiaSubstitute::sentence(double heaviest) const {
  const std::string low = io::format_number(mass, 4), high = io::format_number(heaviest, 4);
  return why + low + (high == low ? "" : " to " + high) + how;
}

std::optional<InertiaSubstitute> substitute_inertia(Link& link, bool may_be_frame) {
  Inertial& own = link.inertial;
  const bool bare = link.collisions.empty() && link.visuals.empty();
  if (own.mass == 0.0 && bare && may_be_frame) return {};
  if (own.mass > 0.0 && positive_definite(own.inertia)) return {};

  const std::optional<Inertial> solid = solid_of_geometry(link, substitute_density);
  const std::string geometry =
      std::string("its ") + (link.collisions.empty() ? "visual" : "collision") + " geometry";
  if (own.mass == 0.0) {
    own = solid ? *solid : sphere_solid(0.01, substitute_density);
    return InertiaSubstitute{
        "no mass; substitute: ", own.mass,
        " kg, " + (solid ? geometry : "a sphere of 10 mm radius") + " at 1000 kg/m3"};
  }
  const std::string why = "no usable inertia (it must be positive definite); substitute: ";
  if (solid) {
    own.inertia = solid->inertia * (own.mass / solid->mass);
    return InertiaSubstitute{why + geometry + " with ", own.mass, " kg spread evenly"};
  }
  const double radius = std::cbrt(own.mass / (substitute_density * 4.0 / 3.0 * pi));
  own.inertia = Mat3::Identity() * (0.4 * own.mass * radius * radius);
  return InertiaSubstitute{why + "a solid sphere of ", own.mass, " kg at 1000 kg/m3"};
}

}  // namespace pedicel::robot
