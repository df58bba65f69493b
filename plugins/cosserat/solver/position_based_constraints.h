#pragma once

#include <cmath>

#include "engine/core/frames.h"

namespace pedicel::cosserat {

/// The two rod constraints of Kugelstadt & Schoemer, "Position and Orientation Based Cosserat Rods"
/// (SCA 2016), as the paper uses them. An orientation moves by a rotation vector delta in its own
/// frame: q <- q exp(delta).

/// Stretch and shear, l C_s with C_s = (p_far - p_near)/l - d3(q), in the frame of q, from the
/// unloaded rest strain: R^T (p_far - p_near) - l (e3 + rest). Unit m.
inline Vec3 stretch_shear(const Vec3& p_near, const Vec3& p_far, const Quat& q, double length,
                          const Vec3& rest) {
  return q.conjugate() * (p_far - p_near) - length * (Vec3::UnitZ() + rest);
}

/// Its derivative by delta; by p_far it is R^T and by p_near -R^T.
inline Mat3 stretch_shear_by_rotation(const Vec3& p_near, const Vec3& p_far, const Quat& q) {
  return skew(q.conjugate() * (p_far - p_near));
}

/// Bend and twist in full, all four parts of l C_b = l (Omega - s Omega0) with
/// Omega = (2/l) conj(q_parent) q and Omega0 = (2/l) rest; s = +-1 is the sign that brings Omega0
/// nearer. x, y, z, w; unit 1 (twice the chord between unit quaternions, rad where small).
inline Eigen::Vector4d bend_twist_in_full(const Quat& parent, const Quat& q, const Quat& rest) {
  const Eigen::Vector4d omega = (parent.conjugate() * q).coeffs();
  const double s = omega.dot(rest.coeffs()) < 0.0 ? -1.0 : 1.0;
  return 2.0 * (omega - s * rest.coeffs());
}

/// The same constraint along the three ways in which q can turn: G^T (l C_b) with G the derivative
/// of l C_b by delta. Multiplying by a unit quaternion keeps lengths, so G^T G = 1 at every bend
/// and every rest rotation, and this 3-vector with the unit gradient makes the same step as all
/// four parts do: it is 2 s vec(conj(rest) conj(q_parent) q), whose length is 2 sin(angle / 2).
/// (The vector part of Omega - s Omega0 by itself would be softer by cos(rest angle / 2).) Unit rad
/// where small; axes of q.
inline Vec3 bend_twist(const Quat& parent, const Quat& q, const Quat& rest) {
  const Quat from_rest = rest.conjugate() * (parent.conjugate() * q);
  return (from_rest.w() < 0.0 ? -2.0 : 2.0) * from_rest.vec();
}

/// One correction turns a segment by no more than this, rad.
inline constexpr double largest_turn = 0.5;

/// The vector, shortened to `limit` where it is longer; zero where it is not finite.
inline Vec3 clamped(const Vec3& v, double limit) {
  const double norm = v.norm();
  if (!std::isfinite(norm)) return Vec3::Zero();
  return norm > limit ? Vec3(limit / norm * v) : v;
}

}  // namespace pedicel::cosserat
