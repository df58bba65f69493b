#pragma once

#include <string>
#include <vector>

#include "plugins/plant/plant_file.h"

/// Kinds of control points. The plant file knows none: a curve is smooth or linear as a whole. In a
/// smooth curve a point becomes a corner by two more points close before and behind it that hold
/// the curve on the straight line to the neighbours; fit_stroke() makes corners in the same way. So
/// a kind is read off the points, and survives saving, loading and other programs.
///
/// A corner whose neighbours are ends of the stem or sharp themselves is a linear point: nothing
/// gives the pieces beside it another direction than straight on. So the middle of three points
/// is smooth or linear.
namespace pedicel::plant {

enum class PointKind {
  smooth,  ///< the curve passes without a bend
  corner,  ///< the curve bends here, the pieces beside it stay curved
  linear,  ///< the curve bends here, the pieces to both neighbours are straight
};

/// A control point without those that hold a corner.
struct ControlPoint {
  int index = 0;  ///< in PlantCurve::points
  PointKind kind = PointKind::smooth;
};
/// In their order. Points of a linear curve are linear.
std::vector<ControlPoint> control_points(const PlantCurve& curve);
/// The kind of a point; smooth for one that holds a corner.
PointKind point_kind(const PlantCurve& curve, int point);
/// The point that this one holds sharp; -1: it is a control point itself.
int held_point(const PlantCurve& curve, int point);

/// Adds or takes away the points that hold it, with the radii that the stem has there. A linear
/// curve becomes a smooth one of linear points once a point of it is made smooth. Returns the
/// point's index now. Throws UsageError for a point that is not there or holds another, and for an
/// end made a corner, which has nothing to bend.
int set_point_kind(PlantFile& plant, const std::string& stem, int point, PointKind kind);

/// Moves a point; those that hold it, or its neighbours' pieces to it, go with it. Returns its
/// index.
int move_control_point(PlantCurve& curve, int point, const Vec3& to);
/// Takes a point away with those that hold it.
void remove_control_point(PlantCurve& curve, int point);

}  // namespace pedicel::plant
