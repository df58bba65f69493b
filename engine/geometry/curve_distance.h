#pragma once

#include "engine/geometry/curve.h"

namespace pedicel::geometry {

struct CurvePoint {
  double arc = 0.0;       ///< m along the curve
  double distance = 0.0;  ///< m from the centre line
};

/// The point of a curve's centre line that is closest to p.
CurvePoint closest_on_curve(const Curve& curve, const Vec3& p);

struct CurvePair {
  double first_arc = 0.0, second_arc = 0.0;  ///< m
  double distance = 0.0;                     ///< m between the centre lines; radii not taken off
};

/// The closest points of two curves' centre lines. Both functions take the best pair of chords (16
/// per piece at least), then refine it to 1e-9 of the length. Exact for linear curves; where a
/// smooth one has two places that are equally close within the chords' sagitta, either is returned.
CurvePair closest_on_curves(const Curve& first, const Curve& second);

}  // namespace pedicel::geometry
