#pragma once

#include <optional>
#include <string>

#include "robot/description.h"

namespace pedicel::robot {

/// Density of substitutes, kg/m3: water, which lies between hollow castings and plastics.
inline constexpr double substitute_density = 1000.0;

/// The even solid of a link's collision geometry (of its visuals where it has none) in link axes.
/// Nothing where the link has no geometry.
std::optional<Inertial> solid_of_geometry(const Link& link, double density);

/// Gives a link the mass and inertia that its URDF leaves out, and returns the sentence that says
/// so; nothing where the link is complete, or a mere frame (`may_be_frame`: it is the root or fixed
/// to its parent; without mass and geometry it needs neither).
///
/// - No mass: the even solid of the geometry at `substitute_density`; without geometry a solid
///   sphere of 10 mm radius at the link's origin.
/// - Mass, but an inertia that is not positive definite: the even solid of the geometry scaled to
///   the stated mass, about the stated centre; without geometry a solid sphere of
///   `substitute_density`.
std::optional<std::string> substitute_inertia(Link& link, bool may_be_frame);

}  // namespace pedicel::robot
