#include "app/window/stroke_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "geometry/curve.h"

namespace pedicel::app {

namespace {

geometry::Curve curve_through(const std::vector<Vec3>& points) {
  const std::vector<double> radii(points.size(), 1.0);
  return geometry::Curve::smooth(points, radii);
}

std::vector<Vec3> samples_of(const std::vector<Vec3>& points, double spacing) {
  const geometry::Curve curve = curve_through(points);
  std::vector<Vec3> samples;
  for (const double arc : curve.sample_arcs(spacing)) samples.push_back(curve.point(arc));
  return samples;
}

double distance_to(const Vec3& point, const std::vector<Vec3>& line) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 along = line[i] - line[i - 1];
    const double share = std::clamp(
        (point - line[i - 1]).dot(along) / std::max(along.squaredNorm(), 1e-24), 0.0, 1.0);
    best = std::min(best, (point - line[i - 1] - share * along).norm());
  }
  return best;
}

/// A hand trembles and pixels are coarse: two passes of the mean with the neighbours, but for
/// places where the line turns sharply.
void calm(std::vector<Vec3>& points, const std::set<int>& fixed) {
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<Vec3> before = points;
    for (int i = 1; i + 1 < static_cast<int>(points.size()); ++i)
      if (!fixed.contains(i))
        points[static_cast<std::size_t>(i)] = 0.25 * before[static_cast<std::size_t>(i - 1)] +
                                              0.5 * before[static_cast<std::size_t>(i)] +
                                              0.25 * before[static_cast<std::size_t>(i + 1)];
  }
}

double turn_at(const std::vector<Vec3>& points, int i, int window) {
  const int last = static_cast<int>(points.size()) - 1;
  const Vec3& here = points[static_cast<std::size_t>(i)];
  const Vec3 before = here - points[static_cast<std::size_t>(std::max(0, i - window))];
  const Vec3 after = points[static_cast<std::size_t>(std::min(last, i + window))] - here;
  const double lengths = before.norm() * after.norm();
  return lengths > 0.0 ? std::acos(std::clamp(before.dot(after) / lengths, -1.0, 1.0)) : 0.0;
}

/// Places where the direction turns by more than the angle within a few points, and more than
/// nearby.
std::set<int> find_corners(const std::vector<Vec3>& points, double angle) {
  constexpr int window = 3;
  std::set<int> corners;
  for (int i = window; i + window < static_cast<int>(points.size()); ++i) {
    const double turn = turn_at(points, i, window);
    bool largest = turn > angle;
    for (int k = i - window; largest && k <= i + window; ++k)
      largest = turn > turn_at(points, k, window) || k >= i;
    if (largest) corners.insert(i), i += window;
  }
  return corners;
}

std::vector<Vec3> chosen(const std::vector<Vec3>& points, const std::set<int>& kept,
                         const std::set<int>& corners, double shoulder) {
  std::vector<Vec3> result;
  const auto towards = [&](int from, int to) -> Vec3 {
    const Vec3 way = points[static_cast<std::size_t>(to)] - points[static_cast<std::size_t>(from)];
    return points[static_cast<std::size_t>(from)] + shoulder * way.normalized();
  };
  for (const int i : kept) {
    const bool corner = corners.contains(i);
    if (corner) result.push_back(towards(i, i - 1));
    result.push_back(points[static_cast<std::size_t>(i)]);
    if (corner) result.push_back(towards(i, i + 1));
  }
  return result;
}

}  // namespace

std::vector<Vec3> resample(const std::vector<Vec3>& stroke, double spacing) {
  std::vector<Vec3> clean;
  double length = 0.0;
  for (const Vec3& point : stroke) {
    const double step = clean.empty() ? 1.0 : (point - clean.back()).norm();
    if (step < 1e-7) continue;
    if (!clean.empty()) length += step;
    clean.push_back(point);
  }
  if (clean.size() < 2 || length < 1e-6) return {};
  const int count = std::max(2, static_cast<int>(std::ceil(length / spacing)) + 1);
  std::vector<Vec3> result = {clean.front()};
  double walked = 0.0;
  std::size_t piece = 1;
  for (int i = 1; i + 1 < count; ++i) {
    const double wanted = length * i / (count - 1);
    double step = (clean[piece] - clean[piece - 1]).norm();
    while (walked + step < wanted && piece + 1 < clean.size()) {
      walked += step;
      ++piece;
      step = (clean[piece] - clean[piece - 1]).norm();
    }
    const double share = std::clamp((wanted - walked) / step, 0.0, 1.0);
    result.push_back(clean[piece - 1] + share * (clean[piece] - clean[piece - 1]));
  }
  result.push_back(clean.back());
  return result;
}

double fit_error(const std::vector<Vec3>& stroke, const std::vector<Vec3>& points) {
  const std::vector<Vec3> line = samples_of(points, 5e-4);
  double worst = 0.0;
  for (const Vec3& point : stroke) worst = std::max(worst, distance_to(point, line));
  return worst;
}

std::vector<Vec3> fit_stroke(const std::vector<Vec3>& stroke, const FitOptions& options) {
  std::vector<Vec3> points = resample(stroke, std::max(0.75 * options.tolerance, 2e-4));
  if (points.size() < 2) return {};
  const int last = static_cast<int>(points.size()) - 1;
  const std::set<int> corners =
      options.corners ? find_corners(points, options.corner_angle) : std::set<int>{};
  calm(points, corners);
  std::set<int> kept = corners;
  kept.insert(0), kept.insert(last);
  const double shoulder = 0.5 * options.tolerance;
  while (static_cast<int>(kept.size()) < options.most_points) {
    const std::vector<Vec3> line = samples_of(chosen(points, kept, corners, shoulder),
                                              std::max(0.3 * options.tolerance, 1e-4));
    int worst = -1;
    double most = options.tolerance;
    for (int i = 0; i <= last; ++i) {
      const double off = distance_to(points[static_cast<std::size_t>(i)], line);
      if (off > most && !kept.contains(i)) most = off, worst = i;
    }
    if (worst < 0) break;
    kept.insert(worst);
  }
  // Two points could not be bent later: a third one in the middle costs nothing.
  if (kept.size() == 2 && last >= 4) kept.insert(last / 2);
  return chosen(points, kept, corners, shoulder);
}

std::vector<double> taper_radii(const std::vector<Vec3>& points, double largest, double smallest,
                                double start, double end) {
  std::vector<double> arcs = {0.0};
  for (std::size_t i = 1; i < points.size(); ++i)
    arcs.push_back(arcs.back() + (points[i] - points[i - 1]).norm());
  std::vector<double> radii;
  for (const double arc : arcs) {
    const double at = arcs.back() > 0.0 ? arc / arcs.back() : 0.0;
    const double share = std::clamp((at - start) / std::max(end - start, 1e-6), 0.0, 1.0);
    radii.push_back(largest + share * (smallest - largest));
  }
  return radii;
}

}  // namespace pedicel::app
