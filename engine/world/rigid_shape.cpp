#include "engine/world/rigid_shape.h"

#include <Eigen/Eigenvalues>
#include <numbers>

#include "engine/robot/bullet_types.h"

namespace pedicel::world {

using robot::from_bullet;
using robot::to_bullet;

namespace {

constexpr double pi = std::numbers::pi;

std::unique_ptr<btCollisionShape> make_part(const BodyPart& part) {
  switch (part.kind) {
    case BodyPart::Kind::box:
      return std::make_unique<btBoxShape>(to_bullet(part.half_extents));
    case BodyPart::Kind::sphere:
      return std::make_unique<btSphereShape>(part.radius);
    case BodyPart::Kind::cylinder:
      return std::make_unique<btCylinderShapeZ>(
          btVector3(part.radius, part.radius, 0.5 * part.length));
    case BodyPart::Kind::capsule:
      return std::make_unique<btCapsuleShapeZ>(part.radius, part.length);
  }
  return nullptr;
}

double volume(const BodyPart& part) {
  const double r = part.radius, ball = 4.0 / 3.0 * pi * r * r * r, rod = pi * r * r * part.length;
  switch (part.kind) {
    case BodyPart::Kind::box:
      return 8.0 * part.half_extents.prod();
    case BodyPart::Kind::sphere:
      return ball;
    case BodyPart::Kind::cylinder:
      return rod;
    case BodyPart::Kind::capsule:
      return rod + ball;
  }
  return 0.0;
}

/// Inertia of all parts about `centre`, and the parallel-axis terms that go with it.
Mat3 inertia_about(const BodyDescription& body, const RigidShape& shape,
                   const std::vector<double>& masses, const Vec3& centre) {
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    btVector3 own;
    shape.parts[i]->calculateLocalInertia(masses[i], own);
    const Mat3 R = body.parts[i].pose.rotation.toRotationMatrix();
    const Vec3 lever = body.parts[i].pose.position - centre;
    sum += R * from_bullet(own).asDiagonal() * R.transpose() +
           masses[i] * (lever.squaredNorm() * Mat3::Identity() - lever * lever.transpose());
  }
  return sum;
}

std::vector<double> masses_of(const BodyDescription& body) {
  std::vector<double> masses;
  double whole = 0.0;
  for (const BodyPart& part : body.parts) whole += masses.emplace_back(volume(part));
  for (double& mass : masses) mass *= body.mass / whole;
  return masses;
}

void find_principal_frame(const BodyDescription& body, RigidShape& shape) {
  const std::vector<double> masses = masses_of(body);
  for (std::size_t i = 0; i < masses.size(); ++i)
    shape.X_BC.position += masses[i] / body.mass * body.parts[i].pose.position;
  const Mat3 inertia = inertia_about(body, shape, masses, shape.X_BC.position);
  // Bodies whose parts stand along the axes keep those as they are.
  if (Mat3(inertia - Mat3(inertia.diagonal().asDiagonal())).norm() < 1e-9 * inertia.norm()) {
    shape.inertia = inertia.diagonal();
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
  shape.X_BC.rotation = Quat(axes);
  shape.inertia = solver.eigenvalues();
}

}  // namespace

RigidShape make_rigid_shape(const BodyDescription& body) {
  RigidShape shape;
  for (const BodyPart& part : body.parts) shape.parts.push_back(make_part(part));
  if (body.mass > 0.0) find_principal_frame(body, shape);
  shape.compound = std::make_unique<btCompoundShape>();
  for (std::size_t i = 0; i < body.parts.size(); ++i)
    shape.compound->addChildShape(to_bullet(shape.X_BC.inverse() * body.parts[i].pose),
                                  shape.parts[i].get());
  return shape;
}

}  // namespace pedicel::world
