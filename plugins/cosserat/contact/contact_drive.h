#pragma once

#include <span>

namespace pedicel::cosserat {

/// A joint whose motor presses colliders against plants, over one step: it goes to `aim` unless
/// what it has to push there takes more than its force; then it stands where the two balance
/// (plugins/coupling/README.md, "Grips"). Positions are the joint's, m or rad; forces N or N m.
struct ContactDrive {
  double reference = 0.0;           ///< where the colliders' poses have it
  double start = 0.0;               ///< where it begins the step
  double aim = 0.0;                 ///< where it ends if nothing is in its way
  double lower = 0.0, upper = 0.0;  ///< its stops, which bear any force
  double press = 0.0;               ///< it goes on against at most this, >= 0
  double hold = 0.0;                ///< it is pushed back by more than this, >= press

  /// N or N m: what it bears before it gives way to smaller positions, just above a position;
  /// negative: it has to be pushed to larger ones with more than that.
  double force_above(double position) const;
};

/// Where a step left it.
struct DriveEnd {
  double position = 0.0;  ///< m or rad
  double load = 0.0;      ///< N or N m, load_at() there
};

/// What a contact is to the joint that presses its collider.
struct DrivenContact {
  int drive = -1;      ///< index into ContactSource::drives(); -1: none
  double lever = 0.0;  ///< m/m or m/rad, how far the collider nears the plant for each m or rad
};

/// A contact as the joint feels it, with what the plant does held fixed: it pushes back with
/// lever * stiffness * max(0, overlap + lever * (position - reference)).
struct DriveLoad {
  double lever = 0.0;      ///< m/m or m/rad
  double stiffness = 0.0;  ///< N/m
  double overlap = 0.0;    ///< m, at the reference; negative: not yet
};

/// N or N m, with which the contacts push the joint towards smaller positions when it is there.
double load_at(const ContactDrive& drive, std::span<const DriveLoad> loads, double position);

/// Where the joint stands: the least of the contacts' energy and what the drive's force has to do
/// on the way from the aim, which is convex. Exact to rounding; does not allocate.
double stand(const ContactDrive& drive, std::span<const DriveLoad> loads);

}  // namespace pedicel::cosserat
