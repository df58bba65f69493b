#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Frames are named by letters: W world, L robot link, P plant base, E rod element, G grid.
/// `p_W` is a point in world coordinates, `R_WL` turns link coordinates into world coordinates,
/// `X_WL` is the pose of the link in the world. SI units, Z up, right-handed. Quaternions are
/// written x, y, z, w in files (Eigen's constructor takes w first).
namespace pedicel {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// A rigid pose: point_A = rotation * point_B + position for X_AB.
struct Pose {
  Vec3 position = Vec3::Zero();      ///< m
  Quat rotation = Quat::Identity();  ///< unit

  Vec3 operator*(const Vec3& point) const { return rotation * point + position; }
  Pose operator*(const Pose& other) const {
    return {rotation * other.position + position, (rotation * other.rotation).normalized()};
  }
  Pose inverse() const {
    const Quat back = rotation.conjugate();
    return {back * -position, back};
  }
};

/// The cross-product matrix: skew(a) * b == a x b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace pedicel
