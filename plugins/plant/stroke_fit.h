#pragma once

#include <vector>

#include "engine/core/frames.h"

/// From a stroke of the hand to the control points of a curve.
namespace pedicel::plant {

struct StrokeSample {
  Vec3 position = Vec3::Zero();  ///< m
  double pressure = 1.0;         ///< 1, 0 to 1, of the pen
};

struct StrokeOptions {
  double tolerance = 0.002;    ///< m, the curve's largest distance from a sample
  bool corners = true;         ///< sharp turns stay sharp
  double corner_angle = 1.2;   ///< rad, of a turn that is a corner
  double radius_from = 0.003;  ///< m, at the stroke's start
  double radius_to = 0.003;    ///< m, at its end; linear in between
  bool use_pressure = false;   ///< radii times the pressure there, at least a tenth
};

/// Control points for PlantCurve: a smooth curve through them is within the tolerance of all
/// samples.
struct FittedStroke {
  std::vector<Vec3> points;    ///< m
  std::vector<double> radius;  ///< m, one a point
  std::vector<int> corners;    ///< indices of points; each stands between two that hold it sharp
  double largest_error = 0.0;  ///< m
};

/// Fits by the loop of P. J. Schneider, "An algorithm for automatically fitting digitized curves",
/// Graphics Gems (1990), 612-626, with the centripetal Catmull-Rom spline that plant files have in
/// place of his Bezier curves: split at corners; from the two ends on, give the samples parameters,
/// solve for the control points by least squares, give them the parameters of the nearest places,
/// and solve again; where the largest error is above the tolerance, add a control point there. A
/// corner is kept by two more points half a tolerance before and behind it. The samples that are
/// fitted pass a running mean of three, which takes the pixels out of a mouse's path; ends and
/// corners stay. Throws UsageError for a stroke without extent or a tolerance that is not positive.
FittedStroke fit_stroke(const std::vector<StrokeSample>& stroke, const StrokeOptions& options);

}  // namespace pedicel::plant
