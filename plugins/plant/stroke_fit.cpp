#include "plugins/plant/stroke_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/curve_distance.h"
#include "plugins/plant/spline_fit.h"

namespace pedicel::plant {

namespace {

constexpr double same_place = 1.0e-5;  // m

/// Samples apart from each other, and how far along the stroke they are.
struct Path {
  std::vector<Vec3> points;
  std::vector<double> pressure, arc;  // 1; m

  explicit Path(const std::vector<StrokeSample>& stroke) {
    for (const StrokeSample& sample : stroke) {
      const double step = points.empty() ? 0.0 : (sample.position - points.back()).norm();
      if (!sample.position.allFinite() || (!points.empty() && step < same_place)) continue;
      arc.push_back(points.empty() ? 0.0 : arc.back() + step);
      points.push_back(sample.position);
      pressure.push_back(std::clamp(sample.pressure, 0.1, 1.0));
    }
  }
  int size() const { return static_cast<int>(points.size()); }
  double length() const { return arc.back(); }

  Vec3 at(double s) const {
    const auto above = std::upper_bound(arc.begin(), arc.end(), s);
    if (above == arc.begin()) return points.front();
    if (above == arc.end()) return points.back();
    const std::size_t i = static_cast<std::size_t>(above - arc.begin());
    const double share = (s - arc[i - 1]) / (arc[i] - arc[i - 1]);
    return points[i - 1] + share * (points[i] - points[i - 1]);
  }
  double pressure_at(double s) const {
    const auto above = std::upper_bound(arc.begin(), arc.end(), s);
    const long i = std::min<long>(above - arc.begin(), size() - 1);
    return pressure[static_cast<std::size_t>(i)];
  }
};

/// The turn at a sample over a distance on both sides, rad.
double turn_at(const Path& path, int i, double reach) {
  const double s = path.arc[i];
  if (s < reach || s > path.length() - reach) return 0.0;
  const Vec3 in = path.points[i] - path.at(s - reach), out = path.at(s + reach) - path.points[i];
  if (in.norm() < same_place || out.norm() < same_place) return 0.0;
  return std::acos(std::clamp(in.normalized().dot(out.normalized()), -1.0, 1.0));
}

/// Samples that are corners: the sharpest of their neighbourhood.
std::vector<int> find_corners(const Path& path, const StrokeOptions& options) {
  std::vector<int> corners;
  if (!options.corners) return corners;
  const double reach = std::min(4.0 * options.tolerance, 0.2 * path.length());
  std::vector<double> turns(path.size());
  for (int i = 0; i < path.size(); ++i) turns[i] = turn_at(path, i, reach);
  for (int i = 0; i < path.size(); ++i) {
    if (turns[i] < options.corner_angle) continue;
    bool sharpest = true;
    for (int j = 0; j < path.size(); ++j)
      if (j != i && std::abs(path.arc[j] - path.arc[i]) < reach &&
          (turns[j] > turns[i] || (turns[j] == turns[i] && j < i)))
        sharpest = false;
    if (sharpest) corners.push_back(i);
  }
  return corners;
}

/// A running mean of three between the ends.
std::vector<Vec3> smoothed(const std::vector<Vec3>& points) {
  std::vector<Vec3> result = points;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    result[i] = (points[i - 1] + points[i] + points[i + 1]) / 3.0;
  return result;
}

geometry::Curve curve_through(const std::vector<Vec3>& points) {
  return geometry::Curve::smooth(points, std::vector<double>(points.size(), 1.0));
}

double largest_error(const std::vector<Vec3>& points, const std::vector<Vec3>& samples) {
  const geometry::Curve curve = curve_through(points);
  double largest = 0.0;
  for (const Vec3& sample : samples)
    largest = std::max(largest, geometry::closest_on_curve(curve, sample).distance);
  return largest;
}

/// The control points of the whole stroke: those of its runs, with corners held sharp.
FittedStroke join_runs(const std::vector<std::vector<Vec3>>& runs, double tolerance) {
  FittedStroke fitted;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<Vec3>& run = runs[r];
    std::size_t first = 0;
    if (r > 0) {
      const Vec3 corner = run.front();
      const auto beside = [&](const Vec3& towards) {
        const Vec3 way = towards - corner;
        return Vec3(corner + std::min(0.5 * tolerance, 0.3 * way.norm()) * way.normalized());
      };
      fitted.points.back() = beside(fitted.points[fitted.points.size() - 2]);
      fitted.corners.push_back(static_cast<int>(fitted.points.size()));
      fitted.points.push_back(corner);
      fitted.points.push_back(beside(run[1]));
      first = 1;
    }
    fitted.points.insert(fitted.points.end(), run.begin() + static_cast<long>(first), run.end());
  }
  return fitted;
}

void add_radii(FittedStroke& fitted, const Path& path, const StrokeOptions& options) {
  const geometry::Curve curve = curve_through(fitted.points);
  for (int i = 0; i < curve.control_points(); ++i) {
    const double share = curve.control_arc(i) / curve.length();
    double radius = options.radius_from + share * (options.radius_to - options.radius_from);
    if (options.use_pressure) radius *= path.pressure_at(share * path.length());
    fitted.radius.push_back(radius);
  }
}

}  // namespace

FittedStroke fit_stroke(const std::vector<StrokeSample>& stroke, const StrokeOptions& options) {
  if (!(options.tolerance > 0.0)) throw UsageError("a tolerance of 0, expected m above 0");
  const Path path(stroke);
  if (path.size() < 2) throw UsageError("a stroke without extent, expected one to draw");
  std::vector<int> ends = find_corners(path, options);
  ends.insert(ends.begin(), 0);
  ends.push_back(path.size() - 1);
  // Where runs meet at a corner, and by smoothing, a little is lost: tighter until it holds.
  for (double inner = 0.8 * options.tolerance;; inner *= 0.6) {
    std::vector<std::vector<Vec3>> runs;
    for (std::size_t r = 0; r + 1 < ends.size(); ++r) {
      const std::vector<Vec3> run(path.points.begin() + ends[r],
                                  path.points.begin() + ends[r + 1] + 1);
      const bool last_try = inner < 0.1 * options.tolerance;
      runs.push_back(last_try ? run : fit_spline(smoothed(run), inner));
    }
    FittedStroke fitted = join_runs(runs, options.tolerance);
    fitted.largest_error = largest_error(fitted.points, path.points);
    if (fitted.largest_error > options.tolerance && inner >= 0.1 * options.tolerance) continue;
    add_radii(fitted, path, options);
    return fitted;
  }
}

}  // namespace pedicel::plant
