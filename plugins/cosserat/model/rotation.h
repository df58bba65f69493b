#pragma once

#include <cmath>

#include "engine/core/frames.h"

namespace pedicel::cosserat {

/// Rotation vector of a unit quaternion, the shorter way round (|phi| <= pi).
inline Vec3 log_map(const Quat& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double w = sign * q.w();
  const double v2 = q.vec().squaredNorm();
  // 2 atan(x) / x with x = |v| / w; below 1e-3 the series is exact to rounding.
  if (v2 < 1.0e-6 * w * w) {
    const double x2 = v2 / (w * w);
    return sign * (2.0 / w) * (1.0 - x2 * (1.0 / 3.0 - x2 * 0.2)) * q.vec();
  }
  const double v = std::sqrt(v2);
  return sign * 2.0 * std::atan2(v, w) / v * q.vec();
}

/// Unit quaternion of a rotation vector.
inline Quat exp_map(const Vec3& phi) {
  const double angle2 = phi.squaredNorm();
  if (angle2 < 1.0e-6) {
    const Vec3 v = (0.5 - angle2 / 48.0) * phi;
    return Quat(1.0 - angle2 / 8.0 + angle2 * angle2 / 384.0, v.x(), v.y(), v.z());
  }
  const double angle = std::sqrt(angle2);
  const Vec3 v = std::sin(0.5 * angle) / angle * phi;
  return Quat(std::cos(0.5 * angle), v.x(), v.y(), v.z());
}

/// d log(q exp(delta)) / d delta at delta = 0, for phi = log(q): the inverse right Jacobian
/// I + [phi]/2 + c [phi]^2 with c = (1 - (phi/2) cot(phi/2)) / phi^2 (Chirikjian, Stochastic
/// Models, Information Theory, and Lie Groups 2, section 10.8). Its transpose is the inverse left
/// Jacobian.
inline Mat3 inverse_right_jacobian(const Vec3& phi) {
  const double angle2 = phi.squaredNorm();
  double c = 1.0 / 12.0 + angle2 / 720.0;
  if (angle2 > 1.0e-4) {
    const double half = 0.5 * std::sqrt(angle2);
    c = (1.0 - half * std::cos(half) / std::sin(half)) / angle2;
  }
  const Mat3 k = skew(phi);
  return Mat3::Identity() + 0.5 * k + c * (k * k);
}

/// The third axis turned by a unit quaternion: where a segment points.
inline Vec3 third_axis(const Quat& q) {
  return {2.0 * (q.x() * q.z() + q.w() * q.y()), 2.0 * (q.y() * q.z() - q.w() * q.x()),
          1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y())};
}

/// The rotation with the least angle that takes unit vector a to unit vector b.
inline Quat least_rotation(const Vec3& a, const Vec3& b) {
  return Quat::FromTwoVectors(a, b);
}

/// A pose on the way from one to another: positions along a straight line, rotations evenly.
inline Pose between(const Pose& from, const Pose& to, double share) {
  return {from.position + share * (to.position - from.position),
          from.rotation.slerp(share, to.rotation)};
}

}  // namespace pedicel::cosserat
