#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/coupling/collider.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/coupling/element_chunks.h"
#include "plugins/coupling/nearest_place.h"

namespace pedicel::coupling {

/// A shape of a plant and a collider that overlap, or are nearer than the margin.
struct Overlap {
  int shape = 0, collider = 0;
  double depth = 0.0;       ///< m, of the surfaces; negative: a gap
  bool is_ignored = false;  ///< the two do not touch from now on
};

/// The contacts of one plant with the shared colliders: at most one for each pair of a shape of the
/// plant and a collider, at their nearest place. A collider that a drive presses is touched at all
/// samples along the shape instead: a stem that lies flat between two pads would roll over its
/// nearest place from end to end. ContactPoint::collider is the collider's index.
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

  /// Every pair that overlaps, or is nearer than `margin` (m), in this state, once each. Nothing is
  /// left out for it.
  std::vector<Overlap> overlaps(const cosserat::RodModel& model, const cosserat::RodState& state,
                                double margin);
  /// Leaves out for good every pair that overlaps, or is nearer than the margin, in this state: a
  /// stem stands in the ground, a trellis wire runs through it. What a drive presses is left out
  /// only where the shape's axis lies inside. Adds to what is left out already. Returns all these
  /// pairs, once each.
  std::vector<Overlap> ignore_touching(const cosserat::RodModel& model,
                                       const cosserat::RodState& state);
  /// The same of one collider alone.
  std::vector<Overlap> ignore_touching(const cosserat::RodModel& model,
                                       const cosserat::RodState& state, int collider);
  /// The same of the pairs, by shape and collider, that `asked` is true for.
  std::vector<Overlap> ignore_touching(const cosserat::RodModel& model,
                                       const cosserat::RodState& state,
                                       const std::function<bool(int, int)>& asked);

  /// For a source that changes what this one finds: it shares the stiffness afterwards.
  void share_later() { shares_ = false; }
  /// A soft collider overlaps the segments beside the nearest one, too. Each would push with the
  /// whole stiffness, and the finer the mesh, the harder the contact would be. So together they
  /// push as the deepest alone would, shared out by their overlaps: most to the deepest, and alike
  /// on both sides of a node. What a drive presses is borne along the stem as it is.
  void share_stiffness(const cosserat::RodModel& model,
                       std::span<cosserat::ContactPoint> points) const;

  /// Goes on with other settings; the margin stays. Throws UsageError where it is another.
  void change_settings(const CouplingSettings& settings);

  void cover(double from, double to) override;
  void begin_step(const cosserat::RodModel& model, const cosserat::RodState& start,
                  double dt) override;
  void find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
            std::vector<cosserat::ContactPoint>& found) override;
  std::span<const cosserat::ContactDrive> drives() const override { return drives_; }
  std::span<const cosserat::DrivenContact> driven() const override { return driven_; }
  void end_drives(std::span<const cosserat::DriveEnd> ends) override;
  /// Of the step that has ended, one a drive of the set.
  const std::vector<cosserat::DriveEnd>& drive_ends() const { return drive_ends_; }

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
  // A shape and a collider, to be looked at.
  struct Touch {
    int shape_index = 0, collider_index = 0;
    const cosserat::CollisionShape& shape;
    const Collider& collider;
    const Placement& at;
    SearchSettings search;
  };
  bool place(const cosserat::RodModel& model, const cosserat::RodState& state, Placed& shape) const;
  void choose_colliders();
  void choose_for(const ElementChunks::Chunk& chunk);
  bool is_ignored(int shape, int collider) const;
  void touch(const cosserat::RodModel& model, const Placed& shape, int collider,
             std::vector<cosserat::ContactPoint>& found);
  void touch_along(const MovingCapsule& capsule, const Touch& touch,
                   std::vector<cosserat::ContactPoint>& found);
  void add(const Touch& touch, const MovingCapsule& capsule, const NearestPlace& nearest,
           double along, std::vector<cosserat::ContactPoint>& found);
  void begin_drives();

  const Placement& placement(int collider) const {
    return covered_.empty() ? colliders_.placement(collider) : covered_[collider];
  }

  const ColliderSet& colliders_;
  CouplingSettings settings_;
  std::vector<Placement> covered_;       // of all colliders, where a part of their way is covered
  std::vector<Vec3> start_position_;     // m, W
  std::vector<Quat> start_orientation_;  // E to W
  ElementChunks chunks_;
  std::vector<int> near_;                       // colliders that may touch this plant
  std::vector<int> chunk_near_;                 // of them, those that may touch the chunk at hand
  std::vector<std::pair<int, int>> ignored_;    // (shape, collider), ascending
  double from_ = 0.0, to_ = 1.0;                // cover()
  bool shares_ = true;                          // share_stiffness() as part of find()
  std::vector<cosserat::ContactDrive> drives_;  // of the step, or the part of it, at hand
  std::vector<cosserat::DrivenContact> driven_;
  std::vector<cosserat::DriveEnd> drive_ends_;
};

}  // namespace pedicel::coupling
