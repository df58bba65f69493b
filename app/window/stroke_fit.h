#pragma once

#include <vector>

#include "core/frames.h"

namespace pedicel::app {

struct FitOptions {
  double tolerance = 0.003;   ///< m, how far the curve may be from the stroke
  bool corners = true;        ///< keep sharp turns sharp
  double corner_angle = 0.9;  ///< rad, a turn that is more than this is a corner
  int most_points = 40;
};

/// A stroke at even distances along it (m), its first and last point kept. Equal neighbours count
/// once; nothing comes back of a stroke shorter than 1e-6 m.
std::vector<Vec3> resample(const std::vector<Vec3>& stroke, double spacing);

/// Control points of a smooth curve (geometry::Curve::smooth) that stays within the tolerance of a
/// stroke, as few as that needs: beginning with the ends and the corners, the place where the curve
/// is farthest off becomes the next point. A corner gets a neighbour on either side, a tolerance
/// away. Fewer than two points: the stroke is too short to be a stem.
std::vector<Vec3> fit_stroke(const std::vector<Vec3>& stroke, const FitOptions& options);

/// Radii along control points: from `largest` at the foot to `smallest` at the tip, changing
/// between the fractions `start` and `end` of the length.
std::vector<double> taper_radii(const std::vector<Vec3>& points, double largest, double smallest,
                                double start, double end);

/// The largest distance from points of the stroke to the smooth curve through `points` (m).
double fit_error(const std::vector<Vec3>& stroke, const std::vector<Vec3>& points);

}  // namespace pedicel::app
