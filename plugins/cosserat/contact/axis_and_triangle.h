#pragma once

#include <array>
#include <optional>

#include "engine/core/frames.h"

namespace pedicel::cosserat {

using Corners = std::array<Vec3, 3>;  ///< m, of a triangle

/// A straight axis; it may be a point. Lengths in m, any frame.
struct Axis {
  Vec3 near = Vec3::Zero(), along = Vec3::Zero();
  Vec3 at(double fraction) const { return near + fraction * along; }
};

/// Where a straight axis and a triangle are nearest.
struct NearestToTriangle {
  double along = 0.5;                       ///< 1, of the axis, 0 at its near end
  Vec3 shares = Vec3::Constant(1.0 / 3.0);  ///< barycentric coordinates
};

/// Minimises |a(s) - T(w)|^2 + e ((s - 1/2)^2 + |w - 1/3|^2) over axis and triangle, with e = 1e-4
/// times the larger one's size squared, as nearest_fractions() does: unique, and continuous where
/// the axis lies flat on the triangle.
NearestToTriangle nearest_to_triangle(const Axis& axis, const Corners& corners);

/// The unit normal of a triangle, about which its corners go round counterclockwise. Nothing of a
/// sliver: its sides mean nothing.
std::optional<Vec3> normal_of(const Corners& corners);

/// The part of an axis that stands over a triangle, on either side: whose foot along the normal
/// lies in it.
struct PartOver {
  std::array<double, 2> at{};      ///< 1, of the axis: its ends
  std::array<double, 2> height{};  ///< m, along the normal, there
};
/// Nothing where no part does. `wider`: by how much farther out each edge (from that corner to the
/// next) lies for each metre below the triangle, where it is above 0: with `side` -1 above.
std::optional<PartOver> part_over(const Axis& axis, const Corners& corners, const Vec3& normal,
                                  const Vec3& wider = Vec3::Zero(), int side = 1);

/// On which side of a triangle a part of an axis belongs, +1 that of the normal, after both moved
/// straight from where they `were` to where they are `now`: the one where it came from if it went
/// through the triangle, else the one where it is. 0: its two ends do not agree.
int side_after(const Axis& was, const Corners& were, const Axis& now, const Corners& corners,
               const PartOver& part);

}  // namespace pedicel::cosserat
