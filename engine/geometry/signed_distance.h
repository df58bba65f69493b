#pragma once

#include "engine/geometry/aabb.h"

namespace pedicel::geometry {

/// The signed distance to the surface of a solid, in the solid's own frame L: negative inside.
/// Evaluation neither allocates nor changes anything, so threads may share an object.
class SignedDistance {
 public:
  virtual ~SignedDistance() = default;

  /// The distance of `p_L` (m). `gradient_L`, where not null, gets the unit direction of steepest
  /// increase: outward. Where several directions are equally steep (a sphere's centre), one of
  /// them.
  virtual double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const = 0;

  /// A box in L around the solid (not around the region where distances are exact).
  virtual Aabb bounds() const = 0;
};

/// v / |v|, or `fallback` where v has no direction.
inline Vec3 unit_or(const Vec3& v, const Vec3& fallback) {
  const double norm = v.norm();
  return norm > 1e-300 ? Vec3(v / norm) : fallback;
}

}  // namespace pedicel::geometry
