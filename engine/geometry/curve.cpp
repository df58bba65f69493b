#include "engine/geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/check.h"
#include "engine/core/stop.h"

namespace pedicel::geometry {

namespace {

/// Parts of a smooth piece over which a 5-point Gauss rule gives the arc length to about 1e-9.
constexpr int kParts = 16;

void check(std::span<const Vec3> points, std::span<const double> radii) {
  if (points.size() < 2)
    throw UsageError("a curve of " + std::to_string(points.size()) +
                     " points: must have at least 2");
  if (radii.size() != points.size())
    throw UsageError(std::to_string(radii.size()) + " radii for " + std::to_string(points.size()) +
                     " points: must be one per point");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw UsageError("point " + std::to_string(i) + " of a curve: must be finite");
    if (!(radii[i] >= 0.0) || !std::isfinite(radii[i]))
      throw UsageError("radius " + std::to_string(i) + " of a curve = " + std::to_string(radii[i]) +
                       " m: must be >= 0");
    if (i > 0 && points[i] == points[i - 1])
      throw UsageError("points " + std::to_string(i - 1) + " and " + std::to_string(i) +
                       " of a curve coincide: must be apart");
  }
}

/// The derivative at p1 of the parabola through three points with knots 0, before, before + after.
Vec3 knot_velocity(const Vec3& p0, const Vec3& p1, const Vec3& p2, double before, double after) {
  return (p1 - p0) / before - (p2 - p0) / (before + after) + (p2 - p1) / after;
}

}  // namespace

double Curve::Piece::length(double from, double to) const {
  constexpr double kNodes[] = {0.0, 0.53846931010568309, 0.90617984593866399};
  constexpr double kWeights[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = kWeights[0] * velocity(middle).norm();
  for (int i = 1; i < 3; ++i)
    sum += kWeights[i] * (velocity(middle - half * kNodes[i]).norm() +
                          velocity(middle + half * kNodes[i]).norm());
  return half * sum;
}

Curve::Curve(std::vector<Piece> pieces, std::span<const double> radii, int parts_per_piece)
    : pieces_(std::move(pieces)), radii_(radii.begin(), radii.end()) {
  double arc = 0.0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    throw_if_stopped();
    control_arcs_.push_back(arc);
    for (int k = 0; k < parts_per_piece; ++k) {
      const double u = double(k) / parts_per_piece;
      knots_.push_back({arc, static_cast<int>(i), u});
      arc += pieces_[i].length(u, double(k + 1) / parts_per_piece);
    }
  }
  control_arcs_.push_back(arc);
  knots_.push_back({arc, static_cast<int>(pieces_.size()) - 1, 1.0});
}

Curve Curve::linear(std::span<const Vec3> points, std::span<const double> radii) {
  check(points, radii);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    pieces.push_back({points[i], points[i + 1] - points[i], Vec3::Zero(), Vec3::Zero()});
  return Curve(std::move(pieces), radii, 1);
}

Curve Curve::smooth(std::span<const Vec3> points, std::span<const double> radii) {
  check(points, radii);
  const std::size_t n = points.size();
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec3 &p1 = points[i], &p2 = points[i + 1];
    const Vec3 p0 = i > 0 ? points[i - 1] : Vec3(2.0 * p1 - p2);
    const Vec3 p3 = i + 2 < n ? points[i + 2] : Vec3(2.0 * p2 - p1);
    const double t01 = std::sqrt((p1 - p0).norm()), t12 = std::sqrt((p2 - p1).norm()),
                 t23 = std::sqrt((p3 - p2).norm());
    // The spline's piece is the cubic with these end velocities (per unit of u).
    const Vec3 v1 = t12 * knot_velocity(p0, p1, p2, t01, t12);
    const Vec3 v2 = t12 * knot_velocity(p1, p2, p3, t12, t23);
    const Vec3 step = p2 - p1;
    pieces.push_back({p1, v1, 3.0 * step - 2.0 * v1 - v2, v1 + v2 - 2.0 * step});
  }
  return Curve(std::move(pieces), radii, kParts);
}

Curve::Place Curve::find(double arc) const {
  arc = std::clamp(arc, 0.0, length());
  const auto behind = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, arc,
                                       [](double a, const Knot& knot) { return a < knot.arc; });
  const Knot& knot = *(behind - 1);
  const double end = behind->piece == knot.piece ? behind->u : 1.0;
  const Piece& piece = pieces_[knot.piece];
  // Newton's method from the chord; the speed hardly changes within a part.
  double u = knot.u + (end - knot.u) * (arc - knot.arc) / (behind->arc - knot.arc);
  for (int i = 0; i < 4; ++i) {
    const double excess = piece.length(knot.u, u) - (arc - knot.arc);
    const double speed = piece.velocity(u).norm();
    if (speed > 0.0) u = std::clamp(u - excess / speed, knot.u, end);
  }
  return {knot.piece, u};
}

Vec3 Curve::point(double arc) const {
  const Place place = find(arc);
  return pieces_[place.piece].at(place.u);
}

Vec3 Curve::tangent(double arc) const {
  const Place place = find(arc);
  return pieces_[place.piece].velocity(place.u).normalized();
}

double Curve::radius(double arc) const {
  arc = std::clamp(arc, 0.0, length());
  const auto behind = std::upper_bound(control_arcs_.begin() + 1, control_arcs_.end() - 1, arc);
  const std::size_t i = static_cast<std::size_t>(behind - control_arcs_.begin());
  const double t = (arc - control_arcs_[i - 1]) / (control_arcs_[i] - control_arcs_[i - 1]);
  return (1.0 - t) * radii_[i - 1] + t * radii_[i];
}

std::vector<double> Curve::sample_arcs(double spacing) const {
  if (!(spacing > 0.0))
    throw UsageError("spacing = " + std::to_string(spacing) + " m: must be > 0");
  std::vector<double> arcs;
  for (std::size_t i = 0; i + 1 < control_arcs_.size(); ++i) {
    const double begin = control_arcs_[i], piece = control_arcs_[i + 1] - begin;
    // A little slack, so that rounding does not add a sample.
    const int parts = std::max(1, static_cast<int>(std::ceil(piece / spacing * (1.0 - 1e-9))));
    for (int k = 0; k < parts; ++k) arcs.push_back(begin + piece * k / parts);
  }
  arcs.push_back(length());
  return arcs;
}

}  // namespace pedicel::geometry
