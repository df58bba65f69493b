#include "coupling/collider_source.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "cosserat/rotation.h"

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

void ColliderSource::change_settings(const CouplingSettings& settings) {
  std::string refusal = check(settings);
  if (settings.margin != settings_.margin) refusal = "CouplingSettings.margin: must stay";
  if (!refusal.empty()) throw UsageError(refusal);
  settings_ = settings;
}

bool ColliderSource::is_ignored(int shape, int collider) const {
  return std::binary_search(ignored_.begin(), ignored_.end(), std::pair(shape, collider));
}

// What gives way (two-way coupling) does so in each part as over the whole step: too far rather
// than not far enough, which could push it and the plant to and fro.
void ColliderSource::cover(double from, double to) {
  covered_.clear();
  if (from == 0.0 && to == 1.0) return;
  for (int i = 0; i < colliders_.size(); ++i) {
    const Placement& whole = colliders_.placement(i);
    Placement& part = covered_.emplace_back(whole);
    if (!whole.is_moving) continue;
    part.X_WC_before = cosserat::between(whole.X_WC_before, whole.X_WC, from);
    part.X_WC = cosserat::between(whole.X_WC_before, whole.X_WC, to);
    part.R_WC_before = part.X_WC_before.rotation.toRotationMatrix();
    part.R_WC = part.X_WC.rotation.toRotationMatrix();
  }
}

void ColliderSource::begin_step(const RodModel& model, const RodState& start, double) {
  if (!chunks_.is_built_for(model)) chunks_.build(model, settings_.margin);
  start_position_ = start.position;
  start_orientation_ = start.orientation;
  chunks_.begin(start.position);
}

void ColliderSource::find(const RodModel& model, const RodState& state, double dt,
                          std::vector<ContactPoint>& found) {
  if (colliders_.size() == 0) return;
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  chunks_.extend(state.position);
  choose_colliders();
  if (near_.empty()) return;
  for (const ElementChunks::Chunk& chunk : chunks_.chunks()) {
    choose_for(chunk);
    if (chunk_near_.empty()) continue;
    for (int i = chunk.first_shape; i < chunk.last_shape; ++i) {
      Placed shape;
      shape.index = chunks_.shapes()[i];
      if (!place(model, state, shape)) continue;
      for (const int collider : chunk_near_)
        if (shape.way_W.intersects(placement(collider).box_W) && !is_ignored(shape.index, collider))
          touch(model, shape, collider, found);
    }
  }
}

// Colliders whose box meets the plant's.
void ColliderSource::choose_colliders() {
  near_.clear();
  for (int i = 0; i < colliders_.size(); ++i) {
    const Placement& at = placement(i);
    if (at.is_active && at.box_W.intersects(chunks_.box_W())) near_.push_back(i);
  }
}

// Of them, those that the chunk's way may meet. A distance changes by at most the way that is gone,
// so one look from the middle of the box tells of the whole box.
void ColliderSource::choose_for(const ElementChunks::Chunk& chunk) {
  chunk_near_.clear();
  for (const int i : near_) {
    const Placement& at = placement(i);
    if (!at.box_W.intersects(chunk.way_W)) continue;
    if (!at.is_moving) {
      const Vec3 middle_C = at.R_WC.transpose() * (chunk.way_W.center() - at.X_WC.position);
      const double radius = 0.5 * chunk.way_W.sizes().norm();
      if (colliders_.collider(i).shape->distance(middle_C) > radius) continue;
    }
    chunk_near_.push_back(i);
  }
}

// False where there is nothing to touch.
bool ColliderSource::place(const RodModel& model, const RodState& state, Placed& placed) const {
  const CollisionShape& shape = model.shapes[placed.index];
  const int e = shape.element;
  if (!state.alive[e] || (shape.fruit >= 0 && state.fruit_gone[shape.fruit])) return false;
  const auto axis_of = [&](const Vec3& node, const Quat& orientation) -> Axis {
    const Vec3 axis = orientation * Vec3::UnitZ();
    return {node - shape.back_near * axis, node - shape.back_far * axis};
  };
  placed.now = axis_of(state.position[e], state.orientation[e]);
  placed.before = axis_of(start_position_[e], start_orientation_[e]);
  // An iterate that has run away meets nothing; the solver reports it.
  if (!std::isfinite((placed.now.near_W + placed.now.far_W).sum())) return false;
  for (const Axis& axis : {placed.now, placed.before})
    placed.way_W.extend(axis.near_W).extend(axis.far_W);
  const double reach = std::max(shape.radius_near, shape.radius_far) + settings_.margin;
  placed.way_W.min().array() -= reach;
  placed.way_W.max().array() += reach;
  return true;
}

namespace {

MovingCapsule in_collider(const CollisionShape& shape, const Placement& at, const Vec3& near_W,
                          const Vec3& far_W, const Vec3& near_before_W, const Vec3& far_before_W) {
  const Mat3 now = at.R_WC.transpose(), before = at.R_WC_before.transpose();
  return {now * (near_W - at.X_WC.position),
          now * (far_W - at.X_WC.position),
          before * (near_before_W - at.X_WC_before.position),
          before * (far_before_W - at.X_WC_before.position),
          shape.radius_near,
          shape.radius_far};
}

}  // namespace

void ColliderSource::touch(const RodModel& model, const Placed& placed, int collider_index,
                           std::vector<ContactPoint>& found) const {
  const CollisionShape& shape = model.shapes[placed.index];
  const Collider& collider = colliders_.collider(collider_index);
  const Placement& at = placement(collider_index);
  const MovingCapsule capsule = in_collider(shape, at, placed.now.near_W, placed.now.far_W,
                                            placed.before.near_W, placed.before.far_W);
  SearchSettings search;
  search.samples = sample_count(shape.back_near - shape.back_far, collider.feature,
                                settings_.samples_per_feature, settings_.most_samples);
  search.flat = 0.1 * settings_.margin;
  // What is farther apart than it moved in this step is not met in the next iteration either.
  search.reach = settings_.margin + capsule.motion();
  const auto nearest = nearest_place(*collider.shape, capsule, search);
  if (!nearest) return;

  ContactPoint point;
  point.shape = placed.index;
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
  point.give = at.give;
  found.push_back(point);
}

}  // namespace pedicel::coupling
