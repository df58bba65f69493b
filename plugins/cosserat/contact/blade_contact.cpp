#include "pedicel/cosserat/contact/blade_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::cosserat {

namespace {

constexpr double skin = 0.006;  // m, of the displacement bound of the list of candidates
// m. Nearer to a blade than this an axis is in it: it has gone through, or is about to.
constexpr double in_blade = 1.0e-5;
constexpr double least_share = 1.0e-6;  // 1, of a corner

Vec3 place_of(const RodState& state, int element, double back) {
  return state.position[element] - back * (state.orientation[element] * Vec3::UnitZ());
}

using Corners = std::array<Vec3, 3>;

Corners corners_of(const RodState& state, const BladeTriangle& face) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = place_of(state, face[i].element, face[i].back);
  return corners;
}

Vec3 place_on(const Corners& corners, const Vec3& shares) {
  return shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2];
}

struct Axis {
  Vec3 near, along;  // m, W
  Vec3 at(double fraction) const { return near + fraction * along; }
};

Axis axis_of(const RodState& state, const CollisionShape& shape) {
  const Vec3 near = place_of(state, shape.element, shape.back_near);
  return {near, place_of(state, shape.element, shape.back_far) - near};
}

// m: how far a material point of an element moved that is at `arm_W` from its child node now.
Vec3 motion_of(const RodState& start, const RodState& now, int element, const Vec3& arm_W) {
  const Vec3 arm = now.orientation[element].conjugate() * arm_W;
  return now.position[element] + arm_W - start.position[element] - start.orientation[element] * arm;
}

// The quadratic program of nearest_to_triangle() in (s, u, v), the fraction along the axis and the
// shares of the first two corners. It is strictly convex: of the minima on all of its faces that
// lie in them, the least is the minimum.
class Program {
 public:
  Program(const Vec3& start, const Vec3& along, const Corners& corners) {
    const Vec3 u = corners[0] - corners[2], v = corners[1] - corners[2];
    const Vec3 apart = start - corners[2];
    Mat3 slopes;
    slopes << along, -u, -v;
    const double size2 =
        std::max({along.squaredNorm(), u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
    const double e = 1.0e-4 * size2;
    hessian_ = slopes.transpose() * slopes;
    hessian_(0, 0) += e;
    hessian_(1, 1) += 2.0 * e, hessian_(2, 2) += 2.0 * e;
    hessian_(1, 2) += e, hessian_(2, 1) += e;
    slope_ = slopes.transpose() * apart - e * Vec3(0.5, 1.0, 1.0);
  }

  NearestToTriangle solve() {
    const Vec3 s = Vec3::UnitX(), u = Vec3::UnitY(), v = Vec3::UnitZ();
    if (!(hessian_.trace() > 0.0)) return {};  // all in one place
    // Inside of both there is no lesser value.
    if (try_face<3>(Vec3::Zero(), {s, u, v})) return best();
    for (const double end : {0.0, 1.0}) try_face<2>(end * s, {u, v});
    for (const auto& [from, to] :
         {std::pair(u, v), std::pair(v, Vec3(Vec3::Zero())), std::pair(Vec3(Vec3::Zero()), u)}) {
      try_face<2>(from, {s, to - from});
      try_face<1>(from, {s});
      for (const double end : {0.0, 1.0}) {
        try_face<1>(from + end * s, {to - from});
        consider(from + end * s);
      }
    }
    return best();
  }

 private:
  double value(const Vec3& x) const { return 0.5 * x.dot(hessian_ * x) + slope_.dot(x); }
  void consider(const Vec3& x) {
    const double here = value(x);
    if (here < least_) least_ = here, at_ = x;
  }
  static bool is_inside(const Vec3& x) {
    constexpr double rounding = 1.0e-12;
    return x.minCoeff() >= -rounding && x[0] <= 1.0 + rounding && x[1] + x[2] <= 1.0 + rounding;
  }
  // The minimum on from + span(ways), where that is inside.
  template <int n>
  bool try_face(const Vec3& from, const std::array<Vec3, n>& ways) {
    Eigen::Matrix<double, 3, n> basis;
    for (int i = 0; i < n; ++i) basis.col(i) = ways[static_cast<std::size_t>(i)];
    const Eigen::Matrix<double, n, n> reduced = basis.transpose() * hessian_ * basis;
    const Eigen::Matrix<double, n, 1> steps =
        -reduced.inverse() * (basis.transpose() * (hessian_ * from + slope_));
    const Vec3 x = from + basis * steps;
    if (!is_inside(x)) return false;
    consider(x);
    return true;
  }
  NearestToTriangle best() const {
    Vec3 shares(std::max(0.0, at_[1]), std::max(0.0, at_[2]), std::max(0.0, 1.0 - at_[1] - at_[2]));
    return {std::clamp(at_[0], 0.0, 1.0), shares / shares.sum()};
  }

  Mat3 hessian_;
  Vec3 slope_, at_ = Vec3(0.5, 1.0 / 3.0, 1.0 / 3.0);
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

NearestToTriangle nearest_to_triangle(const Vec3& start, const Vec3& along,
                                      const std::array<Vec3, 3>& corners) {
  return Program(start, along, corners).solve();
}

BladeContact::BladeContact(const RodModel& joined, std::vector<Plant> plants)
    : plants_(std::move(plants)), shapes_(plants_.size()) {
  for (int p = 0; p < static_cast<int>(plants_.size()); ++p)
    if (plants_[p].blades) add_faces(joined, p);
  for (int i = 0; i < static_cast<int>(joined.shapes.size()); ++i) {
    const int element = joined.shapes[i].element;
    const auto behind = std::ranges::upper_bound(plants_, element, {}, &Plant::first_element);
    shapes_[static_cast<std::size_t>(behind - plants_.begin() - 1)].push_back(i);
  }
  // As drawn nothing moves, so that all that is found overlaps or is within the margin.
  const RodState drawn = drawn_state(joined);
  std::vector<ContactPoint> found;
  std::vector<Candidate> left_out;
  begin_step(joined, drawn, 1.0);
  rebuild(joined, drawn);
  for (const Candidate& pair : candidates_) {
    const Corners corners = corners_of(drawn, faces_[pair.face].corners);
    const CollisionShape& shape = joined.shapes[pair.shape];
    const Axis axis = axis_of(drawn, shape);
    const NearestToTriangle at = nearest_to_triangle(axis.near, axis.along, corners);
    const double radius = shape.radius_near + at.along * (shape.radius_far - shape.radius_near);
    const PlantBlades& blades = *plants_[faces_[pair.face].plant].blades;
    const double gap = (axis.at(at.along) - place_on(corners, at.shares)).norm() - radius -
                       blades.half_thickness();
    if (gap < -blades.settings().margin) left_out.push_back(pair);
  }
  left_out_ = std::move(left_out);
  candidates_.clear();
  reference_.clear();
  start_ = nullptr;
}

void BladeContact::add_faces(const RodModel& joined, int plant) {
  const Plant& of = plants_[plant];
  int organ = -1;
  for (BladeTriangle corners : of.blades->triangles()) {
    for (BladePlace& corner : corners) corner.element += of.first_element;
    const int number = static_cast<int>(faces_.size());
    const int own = joined.elements[corners[0].element].organ;
    if (own != organ) leaves_.push_back({plant, number, number});
    organ = own;
    leaves_.back().last = number + 1;
    faces_.push_back({plant, corners});
  }
}

void BladeContact::begin_step(const RodModel&, const RodState& start, double) {
  start_ = &start;
  start_is_covered_ = false;
}

// Whether the candidates hold for a state: no place of an element moves farther than the farther of
// its ends. What is no number is covered by nothing.
bool BladeContact::is_covered(const RodModel& model, const RodState& state) const {
  if (reference_.size() != state.position.size()) return false;
  for (int e = 0; e < state.size(); ++e) {
    if (!state.alive[e]) continue;
    const Vec3 near = place_of(state, e, model.elements[e].length);
    const double moved = std::max((near - reference_[e].first).squaredNorm(),
                                  (state.position[e] - reference_[e].second).squaredNorm());
    if (!(moved <= 0.25 * skin * skin)) return false;
  }
  return true;
}

// From the step's start to a state, and half of a skin further.
BladeContact::Box BladeContact::way_of(const RodState& state, const Face& face) const {
  Box box;
  for (const RodState* one : {start_, &state})
    for (const Vec3& corner : corners_of(*one, face.corners)) {
      if (!corner.allFinite()) return {};
      box.extend(corner);
    }
  const PlantBlades& blades = *plants_[face.plant].blades;
  const double wider = 0.5 * (skin + blades.settings().margin) + blades.half_thickness();
  box.min().array() -= wider;
  box.max().array() += wider;
  return box;
}

BladeContact::Box BladeContact::way_of(const RodModel& model, const RodState& state,
                                       int shape) const {
  Box box;
  const CollisionShape& one = model.shapes[shape];
  for (const RodState* at : {start_, &state})
    for (const double back : {one.back_near, one.back_far}) {
      const Vec3 end = place_of(*at, one.element, back);
      if (!end.allFinite()) return {};
      box.extend(end);
    }
  const double wider = 0.5 * skin + std::max(one.radius_near, one.radius_far);
  box.min().array() -= wider;
  box.max().array() += wider;
  return box;
}

void BladeContact::rebuild(const RodModel& model, const RodState& state) {
  candidates_.clear();
  shape_ways_.assign(model.shapes.size(), {});
  plant_ways_.assign(plants_.size(), {});
  for (std::size_t p = 0; p < plants_.size(); ++p)
    for (const int shape : shapes_[p]) {
      shape_ways_[shape] = way_of(model, state, shape);
      plant_ways_[p].extend(shape_ways_[shape]);
    }
  for (const Leaf& leaf : leaves_)
    for (int p = 0; p < static_cast<int>(plants_.size()); ++p)
      if (p != leaf.plant) meet(state, leaf, p);
  std::ranges::sort(candidates_);
  std::erase_if(candidates_,
                [&](const Candidate& pair) { return std::ranges::binary_search(left_out_, pair); });
  reference_.resize(state.position.size());
  for (int e = 0; e < state.size(); ++e)
    reference_[e] = {place_of(state, e, model.elements[e].length), state.position[e]};
  start_is_covered_ = true;
}

void BladeContact::meet(const RodState& state, const Leaf& leaf, int plant) {
  Box way;
  for (int f = leaf.first; f < leaf.last; ++f) way.extend(way_of(state, faces_[f]));
  if (way.isEmpty() || !way.intersects(plant_ways_[plant])) return;
  for (const int shape : shapes_[plant]) {
    if (!way.intersects(shape_ways_[shape])) continue;
    for (int f = leaf.first; f < leaf.last; ++f)
      if (way_of(state, faces_[f]).intersects(shape_ways_[shape]))
        candidates_.push_back({f, shape});
  }
}

void BladeContact::find(const RodModel& model, const RodState& state, double dt,
                        std::vector<ContactPoint>& found) {
  if (faces_.empty()) return;
  if (!start_) begin_step(model, state, dt);
  if (!start_is_covered_) start_is_covered_ = is_covered(model, *start_);
  if (!start_is_covered_ || !is_covered(model, state)) rebuild(model, state);
  const auto is_whole = [&](const Candidate& pair) {
    const CollisionShape& shape = model.shapes[pair.shape];
    return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]) &&
           std::ranges::all_of(faces_[pair.face].corners, [&](const BladePlace& corner) {
             return state.alive[corner.element] != 0;
           });
  };
  for (const Candidate& pair : candidates_)
    if (is_whole(pair)) touch(model, state, dt, pair, found);
}

void BladeContact::touch(const RodModel& model, const RodState& state, double dt,
                         const Candidate& pair, std::vector<ContactPoint>& found) const {
  const Face& face = faces_[pair.face];
  const CollisionShape& shape = model.shapes[pair.shape];
  const PlantBlades& blades = *plants_[face.plant].blades;
  const Corners now = corners_of(state, face.corners), were = corners_of(*start_, face.corners);
  const Axis axis = axis_of(state, shape), was = axis_of(*start_, shape);
  double by_blade = 0.0;
  for (std::size_t i = 0; i < 3; ++i) by_blade = std::max(by_blade, (now[i] - were[i]).norm());
  const double by_axis =
      std::max((axis.near - was.near).norm(), (axis.at(1.0) - was.at(1.0)).norm());
  const double moved = by_blade + by_axis;
  if (!std::isfinite(moved)) return;
  // What is farther apart than it moved in this step is not met in the next iteration either.
  const double reach = blades.settings().margin + blades.half_thickness() +
                       std::max(shape.radius_near, shape.radius_far) + moved;
  const Vec3 across = (now[1] - now[0]).cross(now[2] - now[0]);
  const double area = across.norm(), near_end = across.dot(axis.near - now[0]),
               far_end = across.dot(axis.at(1.0) - now[0]);
  if (std::min(near_end, far_end) > reach * area || std::max(near_end, far_end) < -reach * area)
    return;

  Touch touch;
  touch.at = nearest_to_triangle(axis.near, axis.along, now);
  const auto between = [](const Axis& a, const Corners& b, const NearestToTriangle& at) {
    return Vec3(a.at(at.along) - place_on(b, at.shares));
  };
  Vec3 way = between(axis, now, touch.at);
  double distance = way.norm();
  if (distance > in_blade && way.dot(between(was, were, touch.at)) > 0.0) {
    touch.normal_W = way / distance;
  } else {
    // It is in the blade, or beyond. Moved back, by more than both can have moved, towards where it
    // was, it is on its own side, and what is nearest there is what goes back first.
    const NearestToTriangle before = nearest_to_triangle(was.near, was.along, were);
    const Vec3 side = between(was, were, before);
    if (!(side.norm() > in_blade)) return;
    const Vec3 back = (moved + in_blade) * side.normalized();
    touch.at = nearest_to_triangle(axis.near + back, axis.along, now);
    way = between(axis, now, touch.at);
    touch.normal_W = (way + back).normalized();
    distance = way.dot(touch.normal_W);
  }
  touch.radius = shape.radius_near + touch.at.along * (shape.radius_far - shape.radius_near);
  touch.back = shape.back_near + touch.at.along * (shape.back_far - shape.back_near);
  touch.gap = distance - touch.radius - blades.half_thickness();
  const Vec3 arm =
      axis.at(touch.at.along) - touch.radius * touch.normal_W - state.position[shape.element];
  const Vec3 motion = motion_of(*start_, state, shape.element, arm);
  Vec3 motion_of_blade = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const int e = face.corners[i].element;
    const Vec3 own = motion_of(
        *start_, state, e, now[i] + blades.half_thickness() * touch.normal_W - state.position[e]);
    motion_of_blade += touch.at.shares[static_cast<int>(i)] * own;
    touch.motion_W[i] = 0.5 * (motion + own);
  }
  if (!(touch.gap <= blades.settings().margin + (motion - motion_of_blade).norm())) return;
  add_sides(model, dt, pair, touch, found);
}

// As SelfContact adds them, a pair for each corner.
void BladeContact::add_sides(const RodModel& model, double dt, const Candidate& pair,
                             const Touch& touch, std::vector<ContactPoint>& found) const {
  const Face& face = faces_[pair.face];
  const CollisionShape& shape = model.shapes[pair.shape];
  const PlantBlades& blades = *plants_[face.plant].blades;
  const SelfContactSettings& settings = blades.settings();
  double lightest = model.elements[shape.element].mass;
  for (const BladePlace& corner : face.corners)
    lightest = std::min(lightest, model.elements[corner.element].mass);
  const double stiffness = pair_stiffness(settings, shape.fruit >= 0, lightest, dt);
  ContactPoint point;
  point.gap = 0.5 * touch.gap;
  point.friction = settings.friction;
  for (int i = 0; i < 3; ++i) {
    if (touch.at.shares[i] < least_share) continue;
    const BladePlace& corner = face.corners[static_cast<std::size_t>(i)];
    point.stiffening = {touch.at.shares[i] * stiffness, settings.margin};
    take_tangent(point);
    point.surface_motion_W = touch.motion_W[static_cast<std::size_t>(i)];
    point.place = 3 * pair.face + i + 1;
    // The shape of an element has its number.
    add_pair(point, {pair.shape, touch.back, touch.radius},
             {corner.element, corner.back, blades.half_thickness()}, touch.normal_W, found);
  }
}

}  // namespace pedicel::cosserat
