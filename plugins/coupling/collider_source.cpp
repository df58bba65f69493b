#include "plugins/coupling/collider_source.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/check.h"
#include "plugins/cosserat/model/rotation.h"

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

std::vector<Overlap> ColliderSource::ignore_touching(const RodModel& model, const RodState& state) {
  return ignore_touching(model, state, [](int, int) { return true; });
}

std::vector<Overlap> ColliderSource::ignore_touching(const RodModel& model, const RodState& state,
                                                     int collider) {
  return ignore_touching(model, state, [&](int, int one) { return one == collider; });
}

std::vector<Overlap> ColliderSource::overlaps(const RodModel& model, const RodState& state,
                                              double margin) {
  // A step without motion, so that nothing is found by its way.
  begin_step(model, state, 0.0);
  std::vector<ContactPoint> found;
  find(model, state, 0.0, found);
  // A drive's collider is touched in several places along a shape: by pair, so that each is said
  // once. Ordered, so that the report is the same in each run.
  std::map<std::pair<int, int>, Overlap> overlaps;
  for (const ContactPoint& point : found) {
    // What is nearer than the margin pushes already, and would be pushed away at the start.
    if (point.gap > margin) continue;
    Overlap& overlap =
        overlaps.try_emplace({point.shape, point.collider}, Overlap{0, 0, -point.gap})
            .first->second;
    overlap.shape = point.shape;
    overlap.collider = point.collider;
    overlap.depth = std::max(overlap.depth, -point.gap);
    const bool is_deep = point.gap < -point.radius;
    // A pad may push out what it overlaps a little, since its joint gives way. Beyond the axis the
    // distance field points to the other side, and the pad would pull the organ through.
    overlap.is_ignored |= placement(point.collider).drive < 0 || is_deep;
  }
  std::vector<Overlap> all;
  for (const auto& [pair, overlap] : overlaps) all.push_back(overlap);
  return all;
}

// A pair is left out for good and not until it has parted: a stem in the ground parts and meets
// with every sway, and would be thrown out of it.
std::vector<Overlap> ColliderSource::ignore_touching(const RodModel& model, const RodState& state,
                                                     const std::function<bool(int, int)>& asked) {
  std::vector<Overlap> all = overlaps(model, state, settings_.margin);
  std::erase_if(all, [&](const Overlap& one) { return !asked(one.shape, one.collider); });
  for (const Overlap& one : all)
    if (one.is_ignored) ignored_.emplace_back(one.shape, one.collider);
  // Sorted for the binary search: the question is asked for each pair in each iteration.
  std::sort(ignored_.begin(), ignored_.end());
  return all;
}

void ColliderSource::change_settings(const CouplingSettings& settings) {
  std::string refusal = check(settings);
  // The margin is in the boxes of the chunks, and in what was left out at the start.
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
  from_ = from;
  to_ = to;
  covered_.clear();
  if (from == 0.0 && to == 1.0) return;
  for (int i = 0; i < colliders_.size(); ++i) {
    const Placement& whole = colliders_.placement(i);
    // The box stays that of the whole way, which holds every part of it.
    Placement& part = covered_.emplace_back(whole);
    if (!whole.is_moving) continue;
    // The part's motion is what friction is dragged by, so both ends are moved and not only the
    // later one.
    part.X_WC_before = cosserat::between(whole.X_WC_before, whole.X_WC, from);
    part.X_WC = cosserat::between(whole.X_WC_before, whole.X_WC, to);
    part.R_WC_before = part.X_WC_before.rotation.toRotationMatrix();
    part.R_WC = part.X_WC.rotation.toRotationMatrix();
  }
}

void ColliderSource::begin_step(const RodModel& model, const RodState& start, double) {
  // By number of elements and shapes: a model that changes in constants keeps its runs.
  if (!chunks_.is_built_for(model)) chunks_.build(model, settings_.margin);
  // Copied: find() is given iterates only, and each time wants the way from the start.
  start_position_ = start.position;
  start_orientation_ = start.orientation;
  chunks_.begin(start.position);
  begin_drives();
}

// A part of a step begins where the part before it ended.
void ColliderSource::begin_drives() {
  drives_ = colliders_.drives();
  drive_ends_.resize(drives_.size());
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    cosserat::ContactDrive& drive = drives_[d];
    const double start = drive.start;
    drive.reference = start + to_ * (drive.reference - start);
    // A drive makes its way evenly over the parts of a step, as colliders do.
    drive.aim = start + to_ * (drive.aim - start);
    if (from_ > 0.0) drive.start = drive_ends_[d].position;
    // Until a plant says otherwise the joint gets where it was sent.
    drive_ends_[d] = {drive.aim, 0.0};
  }
}

void ColliderSource::end_drives(std::span<const cosserat::DriveEnd> ends) {
  drive_ends_.assign(ends.begin(), ends.end());
}

void ColliderSource::find(const RodModel& model, const RodState& state, double dt,
                          std::vector<ContactPoint>& found) {
  driven_.clear();
  if (colliders_.size() == 0) return;
  // For callers who look for contacts before any step has begun.
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  // Boxes around the way from the start to this iterate: what went through a thin link within the
  // step is met, too.
  chunks_.extend(state.position);
  // Three sieves, from coarse to fine. Most plants of a row are near nothing, and pay for the first
  // one only.
  choose_colliders();
  if (near_.empty()) return;
  const std::size_t first = found.size();
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
  if (shares_) share_stiffness(model, std::span(found).subspan(first));
}

namespace {

// N/m. What is harder touches two segments at once only within a few tenths of a millimetre of the
// node between them.
constexpr double soft = 1.0e5;

// m: nobody is pushed by less.
double overlap_of(const ContactPoint& point) {
  return std::max(0.0, point.margin - point.gap);
}

bool are_neighbours(const RodModel& model, const ContactPoint& one, const ContactPoint& other) {
  if (one.collider != other.collider) return false;
  const int a = model.shapes[one.shape].element, b = model.shapes[other.shape].element;
  return model.elements[a].parent == b || model.elements[b].parent == a;
}

}  // namespace

void ColliderSource::share_stiffness(const RodModel& model, std::span<ContactPoint> points) const {
  if (settings_.contact_stiffness >= soft) return;
  for (ContactPoint& one : points) {
    const double own = overlap_of(one);
    if (own == 0.0 || one.stiffness >= soft || model.shapes[one.shape].fruit >= 0) continue;
    if (placement(one.collider).drive >= 0) continue;
    double deepest = own, sum = own;
    for (const ContactPoint& other : points) {
      if (&other == &one || model.shapes[other.shape].fruit >= 0) continue;
      if (!are_neighbours(model, one, other)) continue;
      const double overlap = overlap_of(other);
      deepest = std::max(deepest, overlap);
      sum += std::pow(overlap / own, 4) * overlap;
    }
    one.stiffness *= deepest / sum;
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
    // Only for what rests: the way of a run is known in W, and in the frame of a moving collider it
    // would be another one.
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
  // What came off is a body of its own and touches as such.
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

// Each end of the way is taken into the frame as it was at that time. In C the collider rests, and
// the way of the capsule is the relative one.
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

// m: how far a drive may still move what it presses, at most, from where it is in this step.
// A joint may still move its pads within the step. Contacts that are not listed cannot be met, and
// the reach has to hold for the whole of that way.
double farthest_travel(const cosserat::ContactDrive& drive, const Placement& at,
                       const MovingCapsule& capsule) {
  const double way =
      std::max(std::abs(drive.aim - drive.reference), std::abs(drive.start - drive.reference));
  const Vec3 middle_W = at.R_WC * (0.5 * (capsule.near_C + capsule.far_C)) + at.X_WC.position;
  return way * (at.drive_linear_W + at.drive_angular_W.cross(middle_W)).norm();
}

// N/m. What a drive can press at all sinks in by half of the radius, not through to the other side.
// A stalk is thinner than what a stiff motor would push into it with the usual spring. Beyond the
// axis the field's gradient turns round, and the pads would pull.
double least_stiffness(const cosserat::ContactDrive& drive, const cosserat::DrivenContact& driven,
                       const Vec3& way_W, double radius) {
  // Where the pad goes along its own surface the lever is zero, but not the force. Half of the way
  // keeps the stiffness finite.
  const double lever = std::max(std::abs(driven.lever), 0.5 * way_W.norm());
  return lever > 0.0 ? drive.hold / (lever * 0.5 * radius) : 0.0;
}

}  // namespace

void ColliderSource::touch(const RodModel& model, const Placed& placed, int collider_index,
                           std::vector<ContactPoint>& found) {
  const CollisionShape& shape = model.shapes[placed.index];
  const Collider& collider = colliders_.collider(collider_index);
  const Placement& at = placement(collider_index);
  const MovingCapsule capsule = in_collider(shape, at, placed.now.near_W, placed.now.far_W,
                                            placed.before.near_W, placed.before.far_W);
  Touch touch{placed.index, collider_index, shape, collider, at, {}};
  // By the collider's smallest part, not by the capsule's length: a thin wire between two samples
  // would not be seen.
  touch.search.samples = sample_count(shape.back_near - shape.back_far, collider.feature,
                                      settings_.samples_per_feature, settings_.most_samples);
  // So little that what is found lies at most a tenth of the margin above the least gap, and enough
  // to keep a stem that lies flat from jumping from end to end.
  touch.search.flat = 0.1 * settings_.margin;
  // What is farther apart than it moved in this step is not met in the next iteration either.
  touch.search.reach = settings_.margin + capsule.motion();
  if (at.drive >= 0) {
    touch.search.reach += farthest_travel(drives_[at.drive], at, capsule);
    return touch_along(capsule, touch, found);
  }
  if (const auto nearest = nearest_place(*collider.shape, capsule, touch.search))
    add(touch, capsule, *nearest, nearest->fraction, found);
}

// Places on the shape that stay, so that what they carry is a function of where the shape is.
void ColliderSource::touch_along(const MovingCapsule& capsule, const Touch& touch,
                                 std::vector<ContactPoint>& found) {
  const double length = touch.shape.back_near - touch.shape.back_far;
  // Places at least as dense as four radii: the pads then bear a thin stalk along its length, not
  // in one point about which it turns.
  const double thinnest = std::min(capsule.radius_near, capsule.radius_far);
  const double feature = std::min(touch.collider.feature, 4.0 * thinnest);
  const int places = length > 0.0 ? sample_count(length, feature, settings_.samples_per_feature,
                                                 settings_.most_samples)
                                  : 1;
  SearchSettings one = touch.search;
  // Each place is a sphere, looked at by itself. The nearest of all would be one that jumps.
  one.samples = 1;
  for (int i = 0; i < places; ++i) {
    // In the middle of equal parts and never at the ends, which neighbouring segments share.
    const double along = (i + 0.5) / places;
    const auto between = [&](const auto& near, const auto& far) {
      return ((1.0 - along) * near + along * far);
    };
    MovingCapsule place;
    place.near_C = place.far_C = between(capsule.near_C, capsule.far_C);
    place.near_before_C = place.far_before_C = between(capsule.near_before_C, capsule.far_before_C);
    place.radius_near = place.radius_far = between(capsule.radius_near, capsule.radius_far);
    if (const auto nearest = nearest_place(*touch.collider.shape, place, one))
      add(touch, place, *nearest, along, found);
  }
}

// `along` is the place on the shape, from its near end.
void ColliderSource::add(const Touch& touch, const MovingCapsule& capsule,
                         const NearestPlace& nearest, double along,
                         std::vector<ContactPoint>& found) {
  const CollisionShape& shape = touch.shape;
  const Placement& at = touch.at;
  ContactPoint point;
  point.shape = touch.shape_index;
  point.collider = touch.collider_index;
  point.back = shape.back_near + along * (shape.back_far - shape.back_near);
  point.radius = nearest.radius;
  point.normal_W = at.R_WC * nearest.normal_C;
  point.gap = nearest.gap;
  // From the axis by radius and gap against the normal: the point on the collider's surface.
  const Vec3 axis_C = (1.0 - nearest.fraction) * capsule.near_C + nearest.fraction * capsule.far_C;
  const Vec3 surface_C = axis_C - (nearest.gap + nearest.radius) * nearest.normal_C;
  // What turns a stem about its own axis takes its surface along: a pad that stands off by the gap
  // moves farther than that, by gap / radius.
  const Vec3 rubbed_C = at.drive >= 0 ? axis_C - nearest.radius * nearest.normal_C : surface_C;
  // The rigid motion of one and the same point of the collider. The difference of two nearest
  // places would count what rolls as dragged.
  if (at.is_moving)
    point.surface_motion_W = at.R_WC * rubbed_C + at.X_WC.position -
                             (at.R_WC_before * rubbed_C + at.X_WC_before.position);
  point.friction = touch.collider.friction.value_or(settings_.friction);
  // Flesh is softer than a stem, and so much that the two cannot share one number.
  point.stiffness = shape.fruit >= 0 ? settings_.fruit_stiffness : settings_.contact_stiffness;
  point.margin = settings_.margin;
  point.give = at.give;
  if (!drives_.empty()) {
    const Vec3 surface_W = at.R_WC * surface_C + at.X_WC.position;
    const Vec3 way_W = at.drive_linear_W + at.drive_angular_W.cross(surface_W);
    const cosserat::DrivenContact driven{at.drive, point.normal_W.dot(way_W)};
    if (at.drive >= 0)
      point.stiffness = std::max(point.stiffness,
                                 least_stiffness(drives_[at.drive], driven, way_W, point.radius));
    // One for each contact of the call, also for those that nothing presses: the lists are read
    // side by side, by number.
    driven_.push_back(driven);
  }
  found.push_back(point);
}

}  // namespace pedicel::coupling
