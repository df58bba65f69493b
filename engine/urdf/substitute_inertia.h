#pragma once

#include <optional>
#include <string>

#include "engine/robot/description.h"

namespace pedicel::robot {

/// Density of substitutes, kg/m3: water, which lies between hollow castings and plastics.
inline constexpr double substitute_density = 1000.0;

/// The even solid of a link's collision geometry (of its visuals where it has none) in link axes.
/// Nothing where the link has no geometry.
std::optional<Inertial> solid_of_geometry(const Link& link, double density);

/// What was put in place of a mass or an inertia. Links with the same `why` and `how` are one kind.
struct InertiaSubstitute {
  std::string why;    ///< "no mass; substitute: "
  double mass = 0.0;  ///< kg
  std::string how;    ///< " kg, its collision geometry at 1000 kg/m3"

  /// The whole sentence, of one link or of several of one kind (from the lightest on).
  std::string sentence(double heaviest) const;
  std::string sentence() const { return sentence(mass); }
};

/// Gives a link the mass and inertia that its URDF leaves out, and returns what is to be said of
/// it; nothing where the link is complete, or a mere frame (`may_be_frame`: it is the root or fixed
/// to its parent; without mass and geometry it needs neither).
///
/// - No mass: the even solid of the geometry at `substitute_density`; without geometry a solid
///   sphere of 10 mm radius at the link's origin.
/// - Mass, but an inertia that is not positive definite: the even solid of the geometry scaled to
///   the stated mass, about the stated centre; without geometry a solid sphere of
///   `substitute_density`.
std::optional<InertiaSubstitute> substitute_inertia(Link& link, bool may_be_frame);

}  // namespace pedicel::robot
