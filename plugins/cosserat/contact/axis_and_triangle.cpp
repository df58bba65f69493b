#include "plugins/cosserat/contact/axis_and_triangle.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pedicel::cosserat {

namespace {

// 1, height of a triangle over its longest edge: below it is a sliver.
constexpr double sliver = 0.05;
// 1, shares of corners: a way through an edge that two triangles have in common goes through one of
// them at least.
constexpr double edge_slack = 1.0e-3;

int sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

// The quadratic program of nearest_to_triangle() in (s, u, v), the fraction along the axis and the
// shares of the first two corners. It is strictly convex: of the minima on all of its faces that
// lie in them, the least is the minimum.
class Program {
 public:
  Program(const Axis& axis, const Corners& corners) {
    const Vec3 u = corners[0] - corners[2], v = corners[1] - corners[2];
    const Vec3 apart = axis.near - corners[2];
    Mat3 slopes;
    slopes << axis.along, -u, -v;
    const double size2 = std::max(
        {axis.along.squaredNorm(), u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
    const double e = 1.0e-4 * size2;
    hessian_ = slopes.transpose() * slopes;
    hessian_(0, 0) += e;
    hessian_(1, 1) += 2.0 * e, hessian_(2, 2) += 2.0 * e;
    hessian_(1, 2) += e, hessian_(2, 1) += e;
    slope_ = slopes.transpose() * apart - e * Vec3(0.5, 1.0, 1.0);
  }

  NearestToTriangle solve() {
    const Vec3 s = Vec3::UnitX(), u = Vec3::UnitY(), v = Vec3::UnitZ();
    if (!(hessian_.trace() > 0.0)) return {};  // all in one place
    // Inside of both there is no lesser value.
    if (try_face<3>(Vec3::Zero(), {s, u, v})) return best();
    for (const double end : {0.0, 1.0}) try_face<2>(end * s, {u, v});
    for (const auto& [from, to] :
         {std::pair(u, v), std::pair(v, Vec3(Vec3::Zero())), std::pair(Vec3(Vec3::Zero()), u)}) {
      try_face<2>(from, {s, to - from});
      try_face<1>(from, {s});
      for (const double end : {0.0, 1.0}) {
        try_face<1>(from + end * s, {to - from});
        consider(from + end * s);
      }
    }
    return best();
  }

 private:
  double value(const Vec3& x) const { return 0.5 * x.dot(hessian_ * x) + slope_.dot(x); }
  void consider(const Vec3& x) {
    const double here = value(x);
    if (here < least_) least_ = here, at_ = x;
  }
  static bool is_inside(const Vec3& x) {
    constexpr double rounding = 1.0e-12;
    return x.minCoeff() >= -rounding && x[0] <= 1.0 + rounding && x[1] + x[2] <= 1.0 + rounding;
  }
  // The minimum on from + span(ways), where that is inside.
  template <int n>
  bool try_face(const Vec3& from, const std::array<Vec3, n>& ways) {
    Eigen::Matrix<double, 3, n> basis;
    for (int i = 0; i < n; ++i) basis.col(i) = ways[static_cast<std::size_t>(i)];
    const Eigen::Matrix<double, n, n> reduced = basis.transpose() * hessian_ * basis;
    const Eigen::Matrix<double, n, 1> steps =
        -reduced.inverse() * (basis.transpose() * (hessian_ * from + slope_));
    const Vec3 x = from + basis * steps;
    if (!is_inside(x)) return false;
    consider(x);
    return true;
  }
  NearestToTriangle best() const {
    Vec3 shares(std::max(0.0, at_[1]), std::max(0.0, at_[2]), std::max(0.0, 1.0 - at_[1] - at_[2]));
    return {std::clamp(at_[0], 0.0, 1.0), shares / shares.sum()};
  }

  Mat3 hessian_;
  Vec3 slope_, at_ = Vec3(0.5, 1.0 / 3.0, 1.0 / 3.0);
  double least_ = std::numeric_limits<double>::infinity();
};

Vec3 shares_of(const Vec3& place, const Corners& corners) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0], w = place - corners[0];
  const Vec3 across = u.cross(v);
  const double b = w.cross(v).dot(across), c = u.cross(w).dot(across), all = across.squaredNorm();
  return Vec3(all - b - c, b, c) / all;
}

// As side_after(), of one place of the axis, whose height is `height` now.
int side_after(const Axis& was, const Corners& were, const Axis& now, const Corners& corners,
               double at, double height) {
  const std::optional<Vec3> normal = normal_of(were);
  if (!normal) return sign(height);
  const Vec3 start = was.at(at), end = now.at(at);
  const Vec3 shares = shares_of(end, corners);
  const Vec3 foot = shares[0] * were[0] + shares[1] * were[1] + shares[2] * were[2];
  const double before = normal->dot(start - foot);
  if (before == 0.0 || before * height > 0.0) return sign(height);
  const double t = before / (before - height);
  Corners then;
  for (std::size_t i = 0; i < 3; ++i) then[i] = were[i] + t * (corners[i] - were[i]);
  const bool through = shares_of(start + t * (end - start), then).minCoeff() >= -edge_slack;
  return sign(through ? before : height);
}

}  // namespace

NearestToTriangle nearest_to_triangle(const Axis& axis, const Corners& corners) {
  return Program(axis, corners).solve();
}

std::optional<Vec3> normal_of(const Corners& corners) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const Vec3 across = u.cross(v);
  const double area = across.norm();
  const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  if (!(area > sliver * longest2)) return {};
  return across / area;
}

std::optional<PartOver> part_over(const Axis& axis, const Corners& corners, const Vec3& normal,
                                  const Vec3& wider, int side) {
  const double height = normal.dot(axis.near - corners[0]), rise = normal.dot(axis.along);
  double from = 0.0, to = 1.0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &corner = corners[static_cast<std::size_t>(i)],
               &next = corners[static_cast<std::size_t>((i + 1) % 3)];
    const Vec3 inward = normal.cross(next - corner).normalized();
    const double inside = inward.dot(axis.near - corner) - side * wider[i] * height;
    const double slope = inward.dot(axis.along) - side * wider[i] * rise;
    if (slope > 0.0)
      from = std::max(from, -inside / slope);
    else if (slope < 0.0)
      to = std::min(to, -inside / slope);
    else if (!(inside >= 0.0))
      return {};
  }
  if (!(from <= to)) return {};
  const PartOver part{{from, to}, {height + from * rise, height + to * rise}};
  // What runs away is over nothing.
  if (!std::isfinite(part.height[0]) || !std::isfinite(part.height[1])) return {};
  return part;
}

int side_after(const Axis& was, const Corners& were, const Axis& now, const Corners& corners,
               const PartOver& part) {
  const int near = side_after(was, were, now, corners, part.at[0], part.height[0]);
  const int far = side_after(was, were, now, corners, part.at[1], part.height[1]);
  return near == far ? near : 0;
}

}  // namespace pedicel::cosserat
