#pragma once

namespace pedicel::plant {

/// A place on a rod: an element and the distance from its child node back towards its parent's.
struct PlacedPoint {
  int element = 0;
  double back = 0.0;  ///< m
};

}  // namespace pedicel::plant
