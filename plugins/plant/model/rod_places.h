#pragma once

#include <vector>

#include "plugins/plant/model/placed_point.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

/// Where the curves of a plant lie on its rods.
struct RodPlaces {
  /// The stretch of a curve that an element covers, in the direction of growth.
  struct Span {
    int element = 0, curve = 0;
    double arc_near = 0.0, arc_far = 0.0;  ///< m along the drawn curve
    double length = 0.0;                   ///< m, of the element
  };
  std::vector<Span> spans;
  std::vector<double> curve_lengths;  ///< m, by the curves' index in the file

  /// Where a fraction `at` of a curve's drawn arc length lies, by the curve's index in the file.
  PlacedPoint locate(int curve, double at) const;
};

}  // namespace pedicel::plant
