#include "engine/geometry/curve_distance.h"

#include <algorithm>
#include <limits>

#include "engine/geometry/aabb.h"
#include "engine/geometry/closest_point.h"

namespace pedicel::geometry {

namespace {

constexpr int kChordsPerPiece = 16;
constexpr int kChordsPerWindow = 8;

/// A part of a curve as chords.
struct Chords {
  std::vector<double> arcs;  ///< m
  std::vector<Vec3> points;

  Chords(const Curve& curve, const std::vector<double>& at) : arcs(at) {
    for (const double arc : arcs) points.push_back(curve.point(arc));
  }
  double arc(std::size_t chord, double t) const {
    return arcs[chord] + t * (arcs[chord + 1] - arcs[chord]);
  }
};

Chords whole(const Curve& curve) {
  std::vector<double> arcs;
  for (int i = 0; i + 1 < curve.control_points(); ++i)
    for (int k = 0; k < kChordsPerPiece; ++k)
      arcs.push_back(curve.control_arc(i) +
                     (curve.control_arc(i + 1) - curve.control_arc(i)) * k / kChordsPerPiece);
  arcs.push_back(curve.length());
  return Chords(curve, arcs);
}

Chords window(const Curve& curve, double centre, double half_width) {
  const double begin = std::max(0.0, centre - half_width);
  const double end = std::min(curve.length(), centre + half_width);
  std::vector<double> arcs;
  for (int k = 0; k <= kChordsPerWindow; ++k)
    arcs.push_back(begin + (end - begin) * k / kChordsPerWindow);
  return Chords(curve, arcs);
}

double longest(const Chords& chords) {
  double step = 0.0;
  for (std::size_t i = 0; i + 1 < chords.arcs.size(); ++i)
    step = std::max(step, chords.arcs[i + 1] - chords.arcs[i]);
  return step;
}

/// Boxes around runs of neighbouring chords.
class Boxes {
 public:
  static constexpr std::size_t chords_a_box = 32;

  explicit Boxes(const Chords& chords) : chords_(chords.points.size() - 1) {
    for (std::size_t i = 0; i < chords_; i += chords_a_box) {
      Aabb& box = boxes_.emplace_back();
      for (std::size_t k = i; k <= end(boxes_.size() - 1); ++k) box.extend(chords.points[k]);
    }
  }
  std::size_t size() const { return boxes_.size(); }
  const Aabb& operator[](std::size_t box) const { return boxes_[box]; }
  std::size_t begin(std::size_t box) const { return box * chords_a_box; }
  std::size_t end(std::size_t box) const { return std::min(begin(box) + chords_a_box, chords_); }

 private:
  std::size_t chords_;
  std::vector<Aabb> boxes_;
};

/// Whether what is in two boxes may be nearer to each other than `distance`, rounding included.
bool may_be_nearer(const Aabb& a, const Aabb& b, double distance) {
  const double rounding = 1.0e-12 * (a.min().cwiseAbs().maxCoeff() + a.sizes().maxCoeff() +
                                     b.min().cwiseAbs().maxCoeff() + b.sizes().maxCoeff());
  return !(a.exteriorDistance(b) > distance + rounding);
}

// Long curves have so many pairs of chords that most are passed over box by box. The order of those
// that are looked at is that of all pairs: of equal distances the first counts.
CurvePair closest(const Chords& a, const Chords& b) {
  CurvePair best{0.0, 0.0, std::numeric_limits<double>::infinity()};
  const Boxes of_a(a), of_b(b);
  std::vector<std::size_t> near;
  for (std::size_t box = 0; box < of_a.size(); ++box) {
    near.clear();
    for (std::size_t other = 0; other < of_b.size(); ++other)
      if (may_be_nearer(of_a[box], of_b[other], best.distance)) near.push_back(other);
    for (std::size_t i = of_a.begin(box); i < of_a.end(box); ++i)
      for (const std::size_t other : near)
        for (std::size_t j = of_b.begin(other); j < of_b.end(other); ++j) {
          const SegmentPair pair =
              closest_on_segments(a.points[i], a.points[i + 1], b.points[j], b.points[j + 1]);
          if (pair.distance < best.distance)
            best = {a.arc(i, pair.s), b.arc(j, pair.t), pair.distance};
        }
  }
  return best;
}

CurvePoint closest(const Chords& chords, const Vec3& p) {
  CurvePoint best{0.0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i + 1 < chords.points.size(); ++i) {
    const Vec3 &a = chords.points[i], &b = chords.points[i + 1];
    const double t = closest_on_segment(p, a, b);
    const double distance = (a + t * (b - a) - p).norm();
    if (distance < best.distance) best = {chords.arc(i, t), distance};
  }
  return best;
}

}  // namespace

CurvePoint closest_on_curve(const Curve& curve, const Vec3& p) {
  const Chords all = whole(curve);
  CurvePoint best = closest(all, p);
  for (double half = longest(all); half > 1e-9 * curve.length(); half *= 0.5)
    best = closest(window(curve, best.arc, half), p);
  best.distance = (curve.point(best.arc) - p).norm();
  return best;
}

CurvePair closest_on_curves(const Curve& first, const Curve& second) {
  const Chords a = whole(first), b = whole(second);
  CurvePair best = closest(a, b);
  double half_a = longest(a), half_b = longest(b);
  while (half_a > 1e-9 * first.length() || half_b > 1e-9 * second.length()) {
    best = closest(window(first, best.first_arc, half_a), window(second, best.second_arc, half_b));
    half_a *= 0.5;
    half_b *= 0.5;
  }
  best.distance = (first.point(best.first_arc) - second.point(best.second_arc)).norm();
  return best;
}

}  // namespace pedicel::geometry
