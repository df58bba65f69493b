#pragma once

#include <span>
#include <vector>

#include "engine/core/frames.h"

namespace pedicel::geometry {

/// A curve through control points with a radius along it, measured by its arc length from the first
/// point. Immutable.
class Curve {
 public:
  /// Straight pieces. `points` and `radii` in metres, one radius per point. Fewer than two points,
  /// coinciding neighbours, other counts of radii, or a radius below 0 are a UsageError.
  static Curve linear(std::span<const Vec3> points, std::span<const double> radii);

  /// The centripetal Catmull-Rom spline (P. J. Barry, R. N. Goldman, SIGGRAPH 1988, with knots
  /// t_i+1 - t_i = sqrt|p_i+1 - p_i|): smooth tangent, no cusps or loops within a piece (C. Yuksel
  /// et al., Comput. Aided Des. 43, 2011). The ends are extended by the mirrored neighbour.
  static Curve smooth(std::span<const Vec3> points, std::span<const double> radii);

  double length() const { return knots_.back().arc; }

  /// All three take an arc length in m, clamped to [0, length].
  Vec3 point(double arc) const;
  /// Unit; at a corner of a linear curve that of the piece behind the corner.
  Vec3 tangent(double arc) const;
  /// m; linear in arc length between control points.
  double radius(double arc) const;

  int control_points() const { return static_cast<int>(control_arcs_.size()); }
  /// Where control point i lies, m.
  double control_arc(int i) const { return control_arcs_.at(i); }

  /// Arc lengths from 0 to length, at most `spacing` (m) apart, control points among them.
  std::vector<double> sample_arcs(double spacing) const;

 private:
  /// A cubic a + b u + c u^2 + d u^3, u in [0, 1].
  struct Piece {
    Vec3 a, b, c, d;
    Vec3 at(double u) const { return a + u * (b + u * (c + u * d)); }
    Vec3 velocity(double u) const { return b + u * (2.0 * c + u * 3.0 * d); }
    double length(double from, double to) const;
  };
  struct Knot {
    double arc;  ///< m
    int piece;
    double u;  ///< where the part behind this knot begins
  };
  struct Place {
    int piece;
    double u;
  };

  Curve(std::vector<Piece> pieces, std::span<const double> radii, int parts_per_piece);
  Place find(double arc) const;

  std::vector<Piece> pieces_;         ///< between neighbouring control points
  std::vector<Knot> knots_;           ///< increasing arc; the last one ends the curve
  std::vector<double> control_arcs_;  ///< m
  std::vector<double> radii_;         ///< m
};

}  // namespace pedicel::geometry
