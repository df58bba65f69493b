#pragma once

#include "engine/core/frames.h"
#include "plugins/cosserat/lanes/lanes.h"

namespace pedicel::cosserat {

// One lane of three or four numbers that stand in lanes.

inline void put(Lanes* to, int lane, const Vec3& v) {
  for (int i = 0; i < 3; ++i) to[i][lane] = v[i];
}

inline void put(Lanes* to, int lane, const Quat& q) {
  for (int i = 0; i < 4; ++i) to[i][lane] = q.coeffs()[i];
}

inline void put(PoseRow& row, int lane, const Vec3& position, const Quat& orientation) {
  put(row.position, lane, position);
  put(row.orientation, lane, orientation);
}

inline Vec3 vector_at(const Lanes* from, int lane) {
  return {from[0][lane], from[1][lane], from[2][lane]};
}

inline Quat rotation_at(const Lanes* from, int lane) {
  return Quat(from[3][lane], from[0][lane], from[1][lane], from[2][lane]);
}

}  // namespace pedicel::cosserat
