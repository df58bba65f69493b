#pragma once

#include <LinearMath/btTransform.h>

#include "engine/core/frames.h"

namespace pedicel::robot {

inline btVector3 to_bullet(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline btQuaternion to_bullet(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
inline btTransform to_bullet(const Pose& pose) {
  return btTransform(to_bullet(pose.rotation), to_bullet(pose.position));
}
inline Vec3 from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Quat from_bullet(const btQuaternion& q) {
  return Quat(q.w(), q.x(), q.y(), q.z());
}
inline Pose from_bullet(const btTransform& t) {
  return {from_bullet(t.getOrigin()), from_bullet(t.getRotation())};
}

}  // namespace pedicel::robot
