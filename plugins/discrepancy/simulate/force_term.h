#pragma once

#include <string>

#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

/// Name of a force from outside the list as an entry of Hypothesis::effects, so that a fit can move
/// its numbers and its place. The word "kind" says which law it follows. With x and v the position
/// and velocity of its place, n the unit vector `towards` tilted by `tilt` (two tangents: about
/// `axis`, the curve's direction, and towards it), P = `about` + `distance` n, and s = -n.(x -
/// about) - offset:
///   constant         force
///   spring           stiffness (P - x)
///   attraction       size range^2/(range^2 + r^2) towards P, r = |P - x|
///   string           stiffness (r - distance - offset) towards P; nothing where that is negative
///   stop             stiffness s n; nothing where that is negative: a string to a far point
///   periodic         sine sin(2 pi frequency t) + cosine cos(2 pi frequency t)
///   drag             -rate v
///   quadratic_drag   -rate |v| v
///   friction         -size v/(|v| + speed)
///   jolt             force, rising and falling linearly within `length` s of `time`
///   onset            force, from `time` on
/// The word "trial" limits it to one trial.
inline constexpr const char* missing_force = "missing_force";

/// What the simulator runs. Throws std::out_of_range where a number is missing.
PointForce point_force(const plant::Effect& force);

/// The force with its numbers free to be fitted, its place along its curve among them. `size` (m)
/// is a length that moves matter against; `duration` (s) is the longest trial's.
Hypothesis free_force(const plant::Effect& force, double size, double duration);

/// Multiplies the force itself.
void scale_force(plant::Effect& force, double factor);

/// n of the laws above.
Vec3 direction_of(const plant::Effect& force);
/// Two unit vectors across a direction.
void across(const Vec3& direction, Vec3& first, Vec3& second);

/// Which law a force follows.
const std::string& kind_of(const plant::Effect& force);
/// In words: "string", "stop", "attraction to a point", "periodic push", ...
std::string plain_kind(const plant::Effect& force);
/// What it is and with which numbers, without its place: "pulls like a string of 3.1 N/m towards
/// (0.2, 0, 0.4) m beyond 0.25 m".
std::string describe(const plant::Effect& force);

}  // namespace pedicel::discrepancy
