#pragma once

#include <cmath>

#include "engine/core/frames.h"

namespace pedicel::plain {

/// The rotation vector of a unit quaternion, the shorter way round.
inline Vec3 rotation_vector(const Quat& q) {
  const double sine = q.vec().norm(), sign = q.w() < 0.0 ? -1.0 : 1.0;
  if (sine < 1.0e-9) return sign * 2.0 * q.vec();
  return sign * 2.0 * std::atan2(sine, std::abs(q.w())) / sine * q.vec();
}

/// The rotation by a rotation vector (rad).
inline Quat turn_by(const Vec3& turn) {
  const double angle = turn.norm();
  if (angle < 1.0e-9) {
    const Vec3 half = 0.5 * turn;
    return Quat(1.0, half.x(), half.y(), half.z()).normalized();
  }
  return Quat(Eigen::AngleAxisd(angle, turn / angle));
}

/// By how much the rotation vector of q changes where q is turned further by a small vector in its
/// own frame: the inverse of the integral of exp(-s [phi]) over s from 0 to 1.
inline Mat3 change_of_vector(const Vec3& phi) {
  const double angle = phi.norm();
  const Mat3 cross = skew(phi);
  Mat3 mean = Mat3::Identity();
  if (angle < 1.0e-3) {
    mean += -0.5 * cross + cross * cross / 6.0 - cross * cross * cross / 24.0;
  } else {
    mean += -(1.0 - std::cos(angle)) / (angle * angle) * cross +
            (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
  }
  return mean.inverse();
}

}  // namespace pedicel::plain
