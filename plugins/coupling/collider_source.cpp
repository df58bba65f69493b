#include "coupling/collider_source.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace pedicel::coupling {

using cosserat::CollisionShape;
using cosserat::ContactPoint;
using cosserat::RodModel;
using cosserat::RodState;

ColliderSource::ColliderSource(const ColliderSet& colliders, const CouplingSettings& settings)
    : colliders_(colliders), settings_(settings) {
  const std::string refusal = check(settings);
  if (!refusal.empty()) throw UsageError(refusal);
}

void ColliderSource::ignore_touching(const RodModel& model, const RodState& state) {
  begin_step(model, state, 0.0);
  std::vector<ContactPoint> found;
  find(model, state, 0.0, found);
  for (const ContactPoint& point : found)
    if (point.gap <= settings_.margin) ignored_.emplace_back(point.shape, point.collider);
  std::sort(ignored_.begin(), ignored_.end());
}

bool ColliderSource::is_ignored(int shape, int collider) const {
  return std::binary_search(ignored_.begin(), ignored_.end(), std::pair(shape, collider));
}

void ColliderSource::begin_step(const RodModel&, const RodState& start, double) {
  start_position_ = start.position;
  start_orientation_ = start.orientation;
}

void ColliderSource::find(const RodModel& model, const RodState& state, double dt,
                          std::vector<ContactPoint>& found) {
  if (colliders_.size() == 0) return;
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  place_shapes(model, state);
  choose_colliders();
  if (near_.empty()) return;
  for (int shape = 0; shape < static_cast<int>(model.shapes.size()); ++shape) {
    if (boxes_[shape].isEmpty()) continue;
    for (const int collider : near_)
      if (boxes_[shape].intersects(colliders_.placement(collider).box_W) &&
          !is_ignored(shape, collider))
        touch(model, shape, collider, found);
  }
}

ColliderSource::Axis ColliderSource::axis_of(const CollisionShape& shape,
                                             const std::vector<Vec3>& position,
                                             const std::vector<Quat>& orientation) const {
  const Vec3& node = position[shape.element];
  const Vec3 axis = orientation[shape.element] * Vec3::UnitZ();
  return {node - shape.back_near * axis, node - shape.back_far * axis};
}

void ColliderSource::place_shapes(const RodModel& model, const RodState& state) {
  const std::size_t count = model.shapes.size();
  axes_.resize(count);
  start_axes_.resize(count);
  boxes_.resize(count);
  box_.setEmpty();
  for (std::size_t i = 0; i < count; ++i) {
    const CollisionShape& shape = model.shapes[i];
    boxes_[i].setEmpty();
    if (!state.alive[shape.element]) continue;
    if (shape.fruit >= 0 && state.fruit_gone[shape.fruit]) continue;
    axes_[i] = axis_of(shape, state.position, state.orientation);
    start_axes_[i] = axis_of(shape, start_position_, start_orientation_);
    // An iterate that has run away meets nothing; the solver reports it.
    if (!std::isfinite((axes_[i].near_W + axes_[i].far_W).sum())) continue;
    const double reach = std::max(shape.radius_near, shape.radius_far) + settings_.margin;
    boxes_[i].extend(axes_[i].near_W).extend(axes_[i].far_W);
    boxes_[i].extend(start_axes_[i].near_W).extend(start_axes_[i].far_W);
    boxes_[i].min().array() -= reach;
    boxes_[i].max().array() += reach;
    box_.extend(boxes_[i]);
  }
}

void ColliderSource::choose_colliders() {
  near_.clear();
  if (box_.isEmpty()) return;
  for (int i = 0; i < colliders_.size(); ++i) {
    const Placement& placement = colliders_.placement(i);
    if (placement.is_active && placement.box_W.intersects(box_)) near_.push_back(i);
  }
}

MovingCapsule ColliderSource::in_collider(const CollisionShape& shape, int index,
                                          const Placement& at) const {
  const Mat3 R_CW = at.R_WC.transpose();
  MovingCapsule capsule;
  capsule.near_C = R_CW * (axes_[index].near_W - at.X_WC.position);
  capsule.far_C = R_CW * (axes_[index].far_W - at.X_WC.position);
  const Mat3 R_before = at.R_WC_before.transpose();
  capsule.near_before_C = R_before * (start_axes_[index].near_W - at.X_WC_before.position);
  capsule.far_before_C = R_before * (start_axes_[index].far_W - at.X_WC_before.position);
  capsule.radius_near = shape.radius_near;
  capsule.radius_far = shape.radius_far;
  return capsule;
}

void ColliderSource::touch(const RodModel& model, int index, int collider_index,
                           std::vector<ContactPoint>& found) const {
  const CollisionShape& shape = model.shapes[index];
  const Collider& collider = colliders_.collider(collider_index);
  const Placement& at = colliders_.placement(collider_index);
  const MovingCapsule capsule = in_collider(shape, index, at);
  SearchSettings search;
  search.samples = sample_count(shape.back_near - shape.back_far, collider.feature,
                                settings_.samples_per_feature, settings_.most_samples);
  search.flat = 0.1 * settings_.margin;
  // What is farther apart than it moved in this step is not met in the next iteration either.
  search.reach = settings_.margin + capsule.motion();
  const auto nearest = nearest_place(*collider.shape, capsule, search);
  if (!nearest) return;

  ContactPoint point;
  point.shape = index;
  point.collider = collider_index;
  point.back = shape.back_near + nearest->fraction * (shape.back_far - shape.back_near);
  point.radius = nearest->radius;
  point.normal_W = at.R_WC * nearest->normal_C;
  point.gap = nearest->gap;
  const Vec3 axis_C =
      (1.0 - nearest->fraction) * capsule.near_C + nearest->fraction * capsule.far_C;
  const Vec3 surface_C = axis_C - (nearest->gap + nearest->radius) * nearest->normal_C;
  if (at.is_moving)
    point.surface_motion_W = at.R_WC * surface_C + at.X_WC.position -
                             (at.R_WC_before * surface_C + at.X_WC_before.position);
  point.friction = collider.friction.value_or(settings_.friction);
  point.stiffness = shape.fruit >= 0 ? settings_.fruit_stiffness : settings_.contact_stiffness;
  point.margin = settings_.margin;
  found.push_back(point);
}

}  // namespace pedicel::coupling
