#pragma once

#include <vector>

#include "cosserat/contact.h"
#include "coupling/collider.h"
#include "coupling/coupling_settings.h"
#include "coupling/element_chunks.h"
#include "coupling/nearest_place.h"

namespace pedicel::coupling {

/// The contacts of one plant with the shared colliders: at most one for each pair of a shape of the
/// plant and a collider, at their nearest place. ContactPoint::collider is the collider's index.
///
/// Three sieves stand before the exact search, so that what is far from everything costs a few
/// comparisons an element: the box of the plant, the boxes of its chunks (element_chunks.h) with
/// one look at the field of a resting collider, and the box of each shape's way.
///
/// Axes are placed as the solver moves them: rigid segments behind their child nodes. Shapes of
/// dead elements and of fruits that are gone are left out. find() does not allocate once warm.
class ColliderSource : public cosserat::ContactSource {
 public:
  /// Keeps a reference to `colliders`, which must outlive it and must not change during a step.
  /// Throws UsageError where a setting is out of its bounds.
  ColliderSource(const ColliderSet& colliders, const CouplingSettings& settings);

  /// Leaves out for good every pair that overlaps, or is nearer than the margin, in this state: a
  /// stem stands in the ground, a trellis wire runs through it. Adds to what is left out already.
  void ignore_touching(const cosserat::RodModel& model, const cosserat::RodState& state);

  /// Goes on with other settings; the margin stays. Throws UsageError where it is another.
  void change_settings(const CouplingSettings& settings);

  void cover(double from, double to) override;
  void begin_step(const cosserat::RodModel& model, const cosserat::RodState& start,
                  double dt) override;
  void find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
            std::vector<cosserat::ContactPoint>& found) override;

 private:
  struct Axis {
    Vec3 near_W, far_W;  // m
  };
  // A shape, where it is and was.
  struct Placed {
    int index = 0;
    Axis now, before;
    geometry::Aabb way_W;  // m, around its way and the margin
  };
  bool place(const cosserat::RodModel& model, const cosserat::RodState& state, Placed& shape) const;
  void choose_colliders();
  void choose_for(const ElementChunks::Chunk& chunk);
  bool is_ignored(int shape, int collider) const;
  void touch(const cosserat::RodModel& model, const Placed& shape, int collider,
             std::vector<cosserat::ContactPoint>& found) const;

  const Placement& placement(int collider) const {
    return covered_.empty() ? colliders_.placement(collider) : covered_[collider];
  }

  const ColliderSet& colliders_;
  CouplingSettings settings_;
  std::vector<Placement> covered_;       // of all colliders, where a part of their way is covered
  std::vector<Vec3> start_position_;     // m, W
  std::vector<Quat> start_orientation_;  // E to W
  ElementChunks chunks_;
  std::vector<int> near_;                     // colliders that may touch this plant
  std::vector<int> chunk_near_;               // of them, those that may touch the chunk at hand
  std::vector<std::pair<int, int>> ignored_;  // (shape, collider), ascending
};

}  // namespace pedicel::coupling
