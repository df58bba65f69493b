#include "plugins/coupling/blade_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/coupling/nearest_place.h"

namespace pedicel::coupling {

using cosserat::ContactPoint;
using cosserat::RodModel;
using cosserat::RodState;

namespace {

// Halvings of a triangle before the place is refined: beyond, a face that lies flat on something
// would be looked at everywhere.
constexpr int most_halvings = 4;
// The refinement goes from 1/16 of the triangle to 1/256.
constexpr int refinements = 5;
// m. Of a triangle that lies flat the middle is taken, as of a capsule: else the place would jump.
constexpr double flat = 2.0e-5;

Vec3 place_on(const std::array<Vec3, 3>& corners, const Vec3& at) {
  return at[0] * corners[0] + at[1] * corners[1] + at[2] * corners[2];
}

const Vec3 middle = Vec3::Constant(1.0 / 3.0);

// Branch and bound: a distance changes by at most the way that is gone.
class Nearest {
 public:
  Nearest(const geometry::SignedDistance& field, const std::array<Vec3, 3>& corners)
      : field_(field), corners_(corners) {}

  double least() const { return least_; }
  const Vec3& at() const { return at_; }

  double look(const Vec3& at) {
    const double distance = field_.distance(place_on(corners_, at));
    const double value = distance + flat * (at - middle).squaredNorm();
    if (value < least_) least_ = value, at_ = at;
    return distance;
  }

  void search(const std::array<Vec3, 3>& part, int halvings, double reach) {
    const Vec3 centre = (part[0] + part[1] + part[2]) / 3.0;
    const double distance = look(centre);
    const Vec3 place = place_on(corners_, centre);
    double radius = 0.0;
    for (const Vec3& corner : part)
      radius = std::max(radius, (place_on(corners_, corner) - place).norm());
    if (halvings == most_halvings || distance - radius > std::min(reach, least_)) return;
    const Vec3 a = 0.5 * (part[1] + part[2]), b = 0.5 * (part[2] + part[0]),
               c = 0.5 * (part[0] + part[1]);
    for (const std::array<Vec3, 3>& quarter :
         {std::array{a, b, c}, {part[0], c, b}, {part[1], a, c}, {part[2], b, a}})
      search(quarter, halvings + 1, reach);
  }

  void refine() {
    double step = std::ldexp(1.0, -most_halvings);
    for (int i = 0; i < refinements; ++i, step *= 0.5)
      for (int k = 0; k < 6; ++k) {
        Vec3 there = at_;
        there[k % 3] += step;
        there[(k % 3 + 1 + k / 3) % 3] -= step;
        // On the rim a step goes as far as there is way.
        there = there.cwiseMax(0.0);
        look(there / there.sum());
      }
  }

 private:
  const geometry::SignedDistance& field_;
  const std::array<Vec3, 3>& corners_;
  double least_ = std::numeric_limits<double>::infinity();
  Vec3 at_ = middle;
};

geometry::Aabb box_of(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double reach) {
  geometry::Aabb box;
  for (int i = 0; i < 3; ++i) box.extend(a[i]).extend(b[i]);
  box.min().array() -= reach;
  box.max().array() += reach;
  return box;
}

double size_of(const std::array<Vec3, 3>& corners) {
  const Vec3 centre = place_on(corners, middle);
  double size = 0.0;
  for (const Vec3& corner : corners) size = std::max(size, (corner - centre).norm());
  return size;
}

void check_settings(const CouplingSettings& settings) {
  const std::string refusal = check(settings);
  if (!refusal.empty()) throw UsageError(refusal);
}

}  // namespace

std::optional<Vec3> nearest_on_triangle(const geometry::SignedDistance& field,
                                        const std::array<Vec3, 3>& corners_C, double reach) {
  Nearest nearest(field, corners_C);
  nearest.search({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 0, reach);
  // What bounds have shown to be far is not refined.
  if (nearest.least() > reach + size_of(corners_C)) return {};
  nearest.refine();
  if (field.distance(place_on(corners_C, nearest.at())) > reach) return {};
  return nearest.at();
}

BladeSource::BladeSource(const ColliderSet& colliders, const CouplingSettings& settings,
                         std::vector<BladeFace> faces)
    : colliders_(colliders), settings_(settings), faces_(std::move(faces)) {
  check_settings(settings);
}

void BladeSource::change_settings(const CouplingSettings& settings) {
  check_settings(settings);
  settings_ = settings;
}

void BladeSource::ignore_touching(const RodModel& model, const RodState& state) {
  begin_step(model, state, 0.0);
  std::vector<ContactPoint> found;
  find(model, state, 0.0, found);
  for (const ContactPoint& point : found)
    if (point.gap <= settings_.margin) ignored_.emplace_back(point.place - 1, point.collider);
  std::ranges::sort(ignored_);
}

void BladeSource::cover(double from, double to) {
  from_ = from;
  to_ = to;
}

void BladeSource::begin_step(const RodModel& model, const RodState& start, double) {
  if (leaves_.empty() && !faces_.empty()) find_leaves(model);
  start_position_ = start.position;
  start_orientation_ = start.orientation;
}

void BladeSource::find_leaves(const RodModel& model) {
  const auto organ = [&](int face) { return model.elements[faces_[face][0].element].organ; };
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    if (leaves_.empty() || organ(f) != organ(leaves_.back().first)) leaves_.push_back({f, f});
    leaves_.back().last = f + 1;
  }
}

// False where some of it came off, or runs away.
bool BladeSource::place(const RodState& state, int face, Corners& now_W, Corners& before_W) const {
  for (int i = 0; i < 3; ++i) {
    const auto [e, back] = faces_[face][i];
    if (!state.alive[e]) return false;
    now_W[i] = state.position[e] - back * (state.orientation[e] * Vec3::UnitZ());
    before_W[i] = start_position_[e] - back * (start_orientation_[e] * Vec3::UnitZ());
    if (!now_W[i].allFinite()) return false;
  }
  return true;
}

// Of the part of the step that is at hand.
BladeSource::Motion BladeSource::motion(int collider) const {
  const Placement& at = colliders_.placement(collider);
  if (!at.is_moving || (from_ == 0.0 && to_ == 1.0)) return {at.X_WC, at.X_WC_before};
  return {cosserat::between(at.X_WC_before, at.X_WC, to_),
          cosserat::between(at.X_WC_before, at.X_WC, from_)};
}

void BladeSource::find(const RodModel& model, const RodState& state, double dt,
                       std::vector<ContactPoint>& found) {
  if (colliders_.size() == 0 || faces_.empty()) return;
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  const double reach = settings_.margin + blade_half_thickness;
  Corners now, before;
  for (const Leaf& leaf : leaves_) {
    // Most leaves are near nothing, and pay for a box.
    geometry::Aabb way;
    for (int f = leaf.first; f < leaf.last; ++f)
      if (place(state, f, now, before)) way.extend(box_of(now, before, reach));
    if (way.isEmpty()) continue;
    for (int c = 0; c < colliders_.size(); ++c) {
      const Placement& at = colliders_.placement(c);
      if (!at.is_active || !at.box_W.intersects(way)) continue;
      // Infinite boxes, as the ground's, meet every leaf.
      const double size = 0.5 * way.sizes().norm();
      if (!at.is_moving &&
          colliders_.collider(c).shape->distance(at.X_WC.inverse() * Vec3(way.center())) > size)
        continue;
      for (int f = leaf.first; f < leaf.last; ++f)
        if (place(state, f, now, before) && at.box_W.intersects(box_of(now, before, reach)) &&
            !std::ranges::binary_search(ignored_, std::pair(f, c)))
          touch(f, c, now, before, found);
    }
  }
}

void BladeSource::touch(int face, int collider, const Corners& now_W, const Corners& before_W,
                        std::vector<ContactPoint>& found) const {
  const Collider& touched = colliders_.collider(collider);
  const Placement& at = colliders_.placement(collider);
  const Motion motion = this->motion(collider);
  const Pose to_C = motion.X_WC.inverse(), to_C_before = motion.X_WC_before.inverse();
  Corners now_C, before_C;
  double moved = 0.0;
  for (int i = 0; i < 3; ++i) {
    now_C[i] = to_C * now_W[i];
    before_C[i] = to_C_before * before_W[i];
    moved = std::max(moved, (now_C[i] - before_C[i]).norm());
  }
  // What is farther apart than it moved in this step is not met in the next iteration either.
  const double reach = settings_.margin + moved;
  const auto shares = nearest_on_triangle(*touched.shape, now_C, reach + blade_half_thickness);
  if (!shares) return;
  // A sphere there, which finds its way back where the step took it through something.
  MovingCapsule sphere;
  sphere.near_C = sphere.far_C = place_on(now_C, *shares);
  sphere.near_before_C = sphere.far_before_C = place_on(before_C, *shares);
  sphere.radius_near = sphere.radius_far = blade_half_thickness;
  SearchSettings search;
  search.samples = 1;
  search.reach = reach;
  const auto nearest = nearest_place(*touched.shape, sphere, search);
  if (!nearest) return;
  ContactPoint point;
  point.collider = collider;
  point.place = face + 1;
  point.radius = blade_half_thickness;
  point.normal_W = motion.X_WC.rotation * nearest->normal_C;
  point.gap = nearest->gap;
  if (at.is_moving) {
    const Vec3 surface_C =
        sphere.near_C - (nearest->gap + blade_half_thickness) * nearest->normal_C;
    point.surface_motion_W = motion.X_WC * surface_C - motion.X_WC_before * surface_C;
  }
  point.friction = touched.friction.value_or(settings_.friction);
  point.margin = settings_.margin;
  point.give = at.give;
  // By Jensen's inequality the three springs together are at least as stiff as one at the place,
  // and where all corners move alike as stiff.
  constexpr double least_share = 1.0e-6;
  for (int i = 0; i < 3; ++i) {
    const double share = (*shares)[i];
    if (share < least_share) continue;
    point.shape = faces_[face][i].element;  // RodModel::shapes: one an element first
    point.back = faces_[face][i].back;
    point.stiffness = share * settings_.contact_stiffness;
    found.push_back(point);
  }
}

}  // namespace pedicel::coupling
