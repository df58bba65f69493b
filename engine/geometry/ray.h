#pragma once

#include "engine/core/frames.h"

namespace pedicel::geometry {

struct Ray {
  Vec3 origin = Vec3::Zero();      ///< m, W
  Vec3 direction = Vec3::UnitX();  ///< unit, W

  /// The place that is `depth` (m) along it.
  Vec3 at(double depth) const { return origin + depth * direction; }
};

}  // namespace pedicel::geometry
