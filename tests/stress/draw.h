#pragma once

#include <cmath>

#include "engine/core/frames.h"
#include "engine/core/random.h"

/// Draws that the stress cases share.
namespace pedicel::stress {

inline bool draw_chance(Random& random, double probability) {
  return random.uniform() < probability;
}

/// Between two positive numbers, uniform in the logarithm.
inline double draw_log(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

/// A unit vector, uniform on the sphere.
inline Vec3 draw_direction(Random& random) {
  const double x = random.normal(), y = random.normal();
  return Vec3(x, y, random.normal()).normalized();
}

/// The rotation by a rotation vector (rad).
inline Quat turn_by(const Vec3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Quat(Eigen::AngleAxisd(angle, turn / angle)) : Quat::Identity();
}

inline Quat draw_rotation(Random& random) {
  const Vec3 axis = draw_direction(random);
  return turn_by(random.uniform(0.0, 3.0) * axis);
}

}  // namespace pedicel::stress
