#include "plugins/coupling/collider.h"

#include <cmath>

#include "engine/core/check.h"

namespace pedicel::coupling {

namespace {

// The box of a turned box, by centre and half sizes: |R| times the halves is exact, and cheaper
// than eight corners.
geometry::Aabb moved(const geometry::Aabb& box, const Mat3& R, const Vec3& position) {
  // A plane is infinite. Turned by numbers, infinity times zero would be no number, and what
  // compares with that meets nothing.
  if (!box.sizes().allFinite()) {
    const double far = std::numeric_limits<double>::infinity();
    return {Vec3::Constant(-far), Vec3::Constant(far)};
  }
  const Vec3 centre = R * box.center() + position;
  const Vec3 half = R.cwiseAbs() * (0.5 * box.sizes());
  return {centre - half, centre + half};
}

// The box around both poses, widened by how far the arc between them may bulge out of the straight
// line: r angle^2 / 8, with r the farthest point of the shape.
void refresh_box(Placement& placement, const geometry::Aabb& bounds) {
  placement.box_W = moved(bounds, placement.R_WC, placement.X_WC.position);
  if (!placement.is_moving || !bounds.sizes().allFinite()) return;
  // Both poses, because plants are looked for on the way that they and the collider go within a
  // step, and not only where it ends.
  placement.box_W.extend(moved(bounds, placement.R_WC_before, placement.X_WC_before.position));
  const double angle = placement.X_WC.rotation.angularDistance(placement.X_WC_before.rotation);
  // From the origin of C, about which the pose turns.
  const double farthest = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).norm();
  placement.box_W.min().array() -= farthest * angle * angle / 8.0;
  placement.box_W.max().array() += farthest * angle * angle / 8.0;
}

}  // namespace

int ColliderSet::add(Collider collider, const Pose& X_WL) {
  if (!collider.shape) throw UsageError("collider '" + collider.name + "': has no shape");
  // Misuse of the interface, so an exception: files have been checked with line and field before.
  if (collider.friction && !(*collider.friction >= 0.0 && *collider.friction <= 10.0))
    throw UsageError("collider '" + collider.name + "': friction = " +
                     std::to_string(*collider.friction) + ": must be between 0 and 10");
  const geometry::Aabb bounds = collider.shape->bounds();
  if (collider.feature <= 0.0) collider.feature = bounds.sizes().minCoeff();
  colliders_.push_back(std::move(collider));
  placements_.emplace_back();
  put(size() - 1, X_WL);
  return size() - 1;
}

void ColliderSet::put(int index, const Pose& X_WL) {
  Placement& placement = placements_[index];
  // Without motion: put far away by a reset, a collider would else sweep through all plants in
  // between, and drag them along by friction.
  placement.X_WC = placement.X_WC_before = X_WL * colliders_[index].X_LC;
  placement.R_WC = placement.R_WC_before = placement.X_WC.rotation.toRotationMatrix();
  placement.is_moving = false;
  refresh_box(placement, colliders_[index].shape->bounds());
}

void ColliderSet::update(std::span<const Pose> X_WL) {
  PEDICEL_ASSERT(X_WL.size() == colliders_.size());
  for (int i = 0; i < size(); ++i) {
    Placement& placement = placements_[i];
    // Before the new pose is taken. The two are the ends of this step's way: what a plant touches
    // moves by their difference.
    placement.X_WC_before = placement.X_WC;
    placement.R_WC_before = placement.R_WC;
    placement.X_WC = X_WL[i] * colliders_[i].X_LC;
    placement.R_WC = placement.X_WC.rotation.toRotationMatrix();
    // Bit by bit. A thing that rests is worth one look at its field for a whole run of elements,
    // and one that moves by a little must not pass for it.
    placement.is_moving = placement.X_WC.position != placement.X_WC_before.position ||
                          placement.R_WC != placement.R_WC_before;
    refresh_box(placement, colliders_[i].shape->bounds());
  }
}

int ColliderSet::add_drive() {
  drives_.emplace_back();
  return static_cast<int>(drives_.size()) - 1;
}

void ColliderSet::press(int index, int drive, const Vec3& linear_W, const Vec3& angular_W) {
  Placement& placement = placements_[index];
  placement.drive = drive;
  placement.drive_linear_W = linear_W;
  placement.drive_angular_W = angular_W;
}

Pose ColliderSet::link_pose(int index) const {
  // From the collider back to its link: only placements are kept, so that the two never disagree.
  return placements_[index].X_WC * colliders_[index].X_LC.inverse();
}

}  // namespace pedicel::coupling
