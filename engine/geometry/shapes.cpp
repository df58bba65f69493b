#include "engine/geometry/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/check.h"

namespace pedicel::geometry {

namespace {

double positive(const char* name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw UsageError(std::string(name) + " = " + std::to_string(value) + " m: must be > 0");
  return value;
}

}  // namespace

SphereDistance::SphereDistance(double radius)
    : radius_(positive("SphereDistance radius", radius)) {}

double SphereDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  if (gradient_L) *gradient_L = unit_or(p_L, Vec3::UnitZ());
  return p_L.norm() - radius_;
}

Aabb SphereDistance::bounds() const {
  return {Vec3::Constant(-radius_), Vec3::Constant(radius_)};
}

BoxDistance::BoxDistance(const Vec3& size) : half_(0.5 * size) {
  for (int i = 0; i < 3; ++i) positive("BoxDistance size", size[i]);
}

double BoxDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  const Vec3 beyond = p_L.cwiseAbs() - half_;  // per axis, outside of the faces
  const Vec3 side(std::copysign(1.0, p_L.x()), std::copysign(1.0, p_L.y()),
                  std::copysign(1.0, p_L.z()));
  int nearest = 0;
  const double deepest = beyond.maxCoeff(&nearest);
  const Vec3 face = side[nearest] * Vec3::Unit(nearest);
  if (deepest <= 0.0) {
    if (gradient_L) *gradient_L = face;
    return deepest;
  }
  const Vec3 outside = beyond.cwiseMax(0.0);
  if (gradient_L) *gradient_L = unit_or(outside.cwiseProduct(side), face);
  return outside.norm();
}

Aabb BoxDistance::bounds() const {
  return {-half_, half_};
}

CylinderDistance::CylinderDistance(double radius, double length)
    : radius_(positive("CylinderDistance radius", radius)),
      half_length_(0.5 * positive("CylinderDistance length", length)) {}

double CylinderDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  // A rectangle in the half plane (rho, z), whose side rho = 0 is no boundary.
  const double rho = std::hypot(p_L.x(), p_L.y());
  const double radial = rho - radius_, axial = std::abs(p_L.z()) - half_length_;
  const bool outside = radial > 0.0 || axial > 0.0;
  const double across = outside ? std::max(radial, 0.0) : radial > axial ? 1.0 : 0.0;
  const double along = outside ? std::max(axial, 0.0) : 1.0 - across;
  if (gradient_L) {
    const Vec3 outward = unit_or(Vec3(p_L.x(), p_L.y(), 0.0), Vec3::UnitX());
    const Vec3 upward(0.0, 0.0, std::copysign(1.0, p_L.z()));
    *gradient_L = (across * outward + along * upward) / std::hypot(across, along);
  }
  return outside ? std::hypot(across, along) : std::max(radial, axial);
}

Aabb CylinderDistance::bounds() const {
  const Vec3 half(radius_, radius_, half_length_);
  return {-half, half};
}

CapsuleDistance::CapsuleDistance(double radius, double length)
    : radius_(positive("CapsuleDistance radius", radius)),
      half_length_(0.5 * positive("CapsuleDistance length", length)) {}

double CapsuleDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  const Vec3 axis_point(0.0, 0.0, std::clamp(p_L.z(), -half_length_, half_length_));
  const Vec3 away = p_L - axis_point;
  if (gradient_L) *gradient_L = unit_or(away, Vec3::UnitX());
  return away.norm() - radius_;
}

Aabb CapsuleDistance::bounds() const {
  const Vec3 half(radius_, radius_, half_length_ + radius_);
  return {-half, half};
}

PlaneDistance::PlaneDistance(const Vec3& normal, double offset) : offset_(offset) {
  const double norm = normal.norm();
  if (!(norm > 0.0) || !std::isfinite(norm))
    throw UsageError("PlaneDistance normal: must be finite and not 0");
  normal_ = normal / norm;
}

double PlaneDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  if (gradient_L) *gradient_L = normal_;
  return normal_.dot(p_L) - offset_;
}

Aabb PlaneDistance::bounds() const {
  const Vec3 unlimited = Vec3::Constant(std::numeric_limits<double>::infinity());
  return {-unlimited, unlimited};
}

PlacedDistance::PlacedDistance(std::shared_ptr<const SignedDistance> solid, const Pose& X_LG)
    : solid_(std::move(solid)), X_LG_(X_LG) {
  if (!solid_) throw UsageError("PlacedDistance: no solid given");
}

double PlacedDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  const double distance =
      solid_->distance(X_LG_.rotation.conjugate() * (p_L - X_LG_.position), gradient_L);
  if (gradient_L) *gradient_L = X_LG_.rotation * *gradient_L;
  return distance;
}

Aabb PlacedDistance::bounds() const {
  const Aabb box = solid_->bounds();
  if (!box.sizes().allFinite()) return box;  // unlimited stays so: turning it would give NaN
  Aabb placed;
  for (int i = 0; i < 8; ++i) placed.extend(X_LG_ * box.corner(static_cast<Aabb::CornerType>(i)));
  return placed;
}

}  // namespace pedicel::geometry
