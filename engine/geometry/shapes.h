#pragma once

#include <memory>

#include "engine/geometry/signed_distance.h"

/// Solids with exact distances, centred at the origin of L, axis along z (URDF's conventions).
/// Sizes in metres; one that is not positive is a UsageError.
namespace pedicel::geometry {

class SphereDistance final : public SignedDistance {
 public:
  explicit SphereDistance(double radius);
  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override;

 private:
  double radius_;
};

class BoxDistance final : public SignedDistance {
 public:
  /// Full edge lengths.
  explicit BoxDistance(const Vec3& size);
  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override;

 private:
  Vec3 half_;
};

/// Between z = -length/2 and z = length/2.
class CylinderDistance final : public SignedDistance {
 public:
  CylinderDistance(double radius, double length);
  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override;

 private:
  double radius_, half_length_;
};

/// All points within `radius` of the segment between z = -length/2 and z = length/2.
class CapsuleDistance final : public SignedDistance {
 public:
  CapsuleDistance(double radius, double length);
  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override;

 private:
  double radius_, half_length_;
};

/// The half space normal . p <= offset, for a ground. Its bounds are unlimited on every axis.
class PlaneDistance final : public SignedDistance {
 public:
  /// `normal` needs not be unit; one without a length is a UsageError.
  explicit PlaneDistance(const Vec3& normal = Vec3::UnitZ(), double offset = 0.0);
  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override;

 private:
  Vec3 normal_;
  double offset_;
};

/// Another solid, placed at X_LG in L (a URDF collision origin).
class PlacedDistance final : public SignedDistance {
 public:
  PlacedDistance(std::shared_ptr<const SignedDistance> solid, const Pose& X_LG);
  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override;

 private:
  std::shared_ptr<const SignedDistance> solid_;
  Pose X_LG_;
};

}  // namespace pedicel::geometry
