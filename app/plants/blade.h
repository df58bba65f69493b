#pragma once

#include <array>

namespace pedicel::app {

/// A corner of a leaf's triangle: a place on an element of a plant.
struct BladeCorner {
  int element = 0;
  double back = 0.0;  ///< m, from the child node
};
using Blade = std::array<BladeCorner, 3>;

}  // namespace pedicel::app
