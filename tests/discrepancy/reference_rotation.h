#pragma once

#include <cmath>

#include "engine/core/frames.h"

/// Rotation vectors, written anew for the reference simulator.
namespace pedicel::reference {

inline Quat rotation_exp(const Vec3& v) {
  const double angle2 = v.squaredNorm(), half = 0.5 * std::sqrt(angle2);
  const double s = angle2 < 1e-8 ? 0.5 - angle2 / 48.0 : std::sin(half) / (2.0 * half);
  return Quat(std::cos(half), s * v.x(), s * v.y(), s * v.z());
}

inline Vec3 rotation_log(const Quat& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0, n = q.vec().norm();
  const double factor =
      n < 1e-6 ? 2.0 * (1.0 + n * n / 6.0) : 2.0 * std::atan2(n, sign * q.w()) / n;
  return sign * factor * q.vec();
}

/// c of inverse_tangent().
inline double inverse_tangent_factor(const Vec3& v) {
  const double a2 = v.squaredNorm();
  if (a2 < 1e-3) return 1.0 / 12.0 + a2 * (1.0 / 720.0 + a2 / 30240.0);
  const double a = std::sqrt(a2);
  return (1.0 - 0.5 * a * std::sin(a) / (1.0 - std::cos(a))) / a2;
}

/// d v / d (rotation in the turned frame) at exp(v): v' = inverse_tangent(v) w, w in the body, is
/// 1 + v x / 2 + c v x v x. Iserles et al., "Lie-group methods", Acta Numerica 9 (2000), eq. B.11
/// with the sign of a body rate.
inline Mat3 inverse_tangent(const Vec3& v) {
  const Mat3 s = skew(v);
  return Mat3::Identity() + 0.5 * s + inverse_tangent_factor(v) * s * s;
}

/// inverse_tangent(v) w
inline Vec3 turn_rate(const Vec3& v, const Vec3& w) {
  const Vec3 cross = v.cross(w);
  return w + 0.5 * cross + inverse_tangent_factor(v) * v.cross(cross);
}

}  // namespace pedicel::reference
