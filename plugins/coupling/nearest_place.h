#pragma once

#include <optional>

#include "engine/geometry/signed_distance.h"

namespace pedicel::coupling {

/// A tapered capsule (a sphere where both ends are the same) in a collider's frame C, now and at
/// the start of the step: its motion is the motion relative to the collider.
struct MovingCapsule {
  Vec3 near_C = Vec3::Zero(), far_C = Vec3::Zero();                ///< m, ends of the axis
  Vec3 near_before_C = Vec3::Zero(), far_before_C = Vec3::Zero();  ///< m, at the step's start
  double radius_near = 0.0, radius_far = 0.0;                      ///< m

  /// How far its fastest end moved (m).
  double motion() const {
    return std::max((near_C - near_before_C).norm(), (far_C - far_before_C).norm());
  }
};

/// Where a capsule touches, or would touch first.
struct NearestPlace {
  double fraction = 0.0;          ///< 1, along the axis from the near end
  double radius = 0.0;            ///< m
  double gap = 0.0;               ///< m, between the surfaces; negative: overlap
  Vec3 normal_C = Vec3::UnitZ();  ///< unit, from the collider to the capsule
};

struct SearchSettings {
  int samples = 2;       ///< 1, evenly along the axis, >= 1
  double reach = 0.0;    ///< m, gaps above it are of no interest
  double flat = 2.0e-5;  ///< m, the pull towards the middle of the axis, see below
};

/// The nearest place of a capsule to a signed distance field, as the paper has it: the axis is
/// sampled evenly and the nearest sample is the contact. Here it is then refined by a
/// golden-section search between its neighbours, and what is minimised is gap(f) + 4 flat (f -
/// 1/2)^2: a capsule that lies flat touches in its middle, and rolls to an end as it tilts, instead
/// of being thrown from end to end. The place found is at most `flat` farther than the nearest one.
///
/// A sample that went through the body's surface during the step, or through to the far side of it,
/// is found by following its way through the field (sphere tracing) and gets the plane of entry as
/// its contact: it is pushed to the side from which it came.
///
/// Nothing where the gap is above `reach`.
std::optional<NearestPlace> nearest_place(const geometry::SignedDistance& field,
                                          const MovingCapsule& capsule,
                                          const SearchSettings& settings);

/// Samples for a capsule of this length: one per feature / per_feature, both ends included; 1 for a
/// sphere, 2 where the feature is infinite (a plane).
int sample_count(double length, double feature, int per_feature, int most);

}  // namespace pedicel::coupling
