#include "plugins/cosserat/contact/blade_contact.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pedicel::cosserat {

namespace {

constexpr double skin = 0.006;  // m, of the displacement bound of the list of candidates
// m. Nearer to a blade than this an axis is in it: it has gone through, or is about to.
constexpr double in_blade = 1.0e-5;
constexpr double least_share = 1.0e-6;  // 1, of a corner
// m/m. Beyond a fold of a leaf lies a wedge that is under neither face. What is through stays under
// both faces of a fold of up to 53 degrees, 2 atan(this).
constexpr double fold = 0.5;

Vec3 place_of(const RodState& state, int element, double back) {
  return state.position[element] - back * (state.orientation[element] * Vec3::UnitZ());
}

Corners corners_of(const RodState& state, const BladeTriangle& face) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = place_of(state, face[i].element, face[i].back);
  return corners;
}

Vec3 place_on(const Corners& corners, const Vec3& shares) {
  return shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2];
}

Axis axis_of(const RodState& state, const CollisionShape& shape) {
  const Vec3 near = place_of(state, shape.element, shape.back_near);
  return {near, place_of(state, shape.element, shape.back_far) - near};
}

// m: how far a material point of an element moved that is at `arm_W` from its child node now.
Vec3 motion_of(const RodState& start, const RodState& now, int element, const Vec3& arm_W) {
  const Vec3 arm = now.orientation[element].conjugate() * arm_W;
  return now.position[element] + arm_W - start.position[element] - start.orientation[element] * arm;
}

bool is_same(const BladePlace& a, const BladePlace& b) {
  return a.element == b.element && a.back == b.back;
}

}  // namespace

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
    const NearestToTriangle at = nearest_to_triangle(axis, corners);
    const double radius = shape.radius_near + at.along * (shape.radius_far - shape.radius_near);
    const PlantBlades& blades = *plants_[faces_[pair.face].plant].blades;
    const double gap = (axis.at(at.along) - place_on(corners, at.shares)).norm() - radius -
                       blades.half_thickness();
    if (gap < -blades.settings().margin) left_out.push_back(pair);
  }
  left_out_ = std::move(left_out);
  candidates_.clear();
  sides_.clear();
  reference_.clear();
  start_ = nullptr;
  forget();
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
    Face face;
    face.plant = plant;
    face.corners = corners;
    face.leaf = static_cast<int>(leaves_.size()) - 1;
    faces_.push_back(face);
  }
  for (const Leaf& leaf : leaves_)
    if (leaf.plant == plant) join_faces(leaf);
}

void BladeContact::join_faces(const Leaf& leaf) {
  // 1: they go along an edge the same way, -1: against each other, 0: it is not the same edge.
  const auto along = [&](const Face& f, std::size_t i, const Face& g, std::size_t j) {
    const BladePlace &a = f.corners[i], &b = f.corners[(i + 1) % 3];
    const BladePlace &c = g.corners[j], &d = g.corners[(j + 1) % 3];
    if (is_same(a, c) && is_same(b, d)) return 1;
    return is_same(a, d) && is_same(b, c) ? -1 : 0;
  };
  for (int f = leaf.first; f < leaf.last; ++f) faces_[f].patch = -1;
  std::vector<int> open;
  for (int first = leaf.first; first < leaf.last; ++first) {
    if (faces_[first].patch >= 0) continue;
    faces_[first].patch = first;
    open.push_back(first);
    while (!open.empty()) {
      const int number = open.back();
      Face& f = faces_[number];
      open.pop_back();
      for (int other = leaf.first; other < leaf.last; ++other)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) {
            Face& g = faces_[other];
            const int way = other == number ? 0 : along(f, i, g, j);
            if (way == 0) continue;
            f.inner[static_cast<int>(i)] = 1.0;
            if (g.patch >= 0) continue;
            g.patch = first;
            // Where corners go round alike, neighbours go along their edge against each other.
            g.turn = -way * f.turn;
            open.push_back(other);
          }
    }
  }
}

void BladeContact::forget() {
  std::ranges::fill(sides_, Side{});
  any_through_ = false;
  before_.position.clear();
}

void BladeContact::begin_step(const RodModel& model, const RodState& start, double) {
  remember(model, start);
  before_.position = start.position;
  before_.orientation = start.orientation;
  start_ = &start;
  start_is_covered_ = false;
}

// A side is taken from one start of a step to the next, and not from an iterate: so what a step
// tried does not count, nor how often it was tried.
void BladeContact::remember(const RodModel& model, const RodState& start) {
  if (before_.size() != start.size()) return;
  old_sides_.resize(candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    old_sides_[i] = standing(model, before_, start, i).side;
  sides_.swap(old_sides_);
  any_through_ = std::ranges::any_of(sides_, &Side::is_through);
}

bool BladeContact::is_whole(const RodModel& model, const RodState& state,
                            const Candidate& pair) const {
  const CollisionShape& shape = model.shapes[pair.shape];
  return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]) &&
         std::ranges::all_of(faces_[pair.face].corners, [&](const BladePlace& corner) {
           return state.alive[corner.element] != 0;
         });
}

// The side of a shape that is through another face of the same patch; 0: it is not.
int BladeContact::side_in_patch(const Candidate& pair) const {
  if (!any_through_) return 0;
  const Face& face = faces_[pair.face];
  const Leaf& leaf = leaves_[face.leaf];
  for (int f = leaf.first; f < leaf.last; ++f) {
    if (f == pair.face || faces_[f].patch != face.patch) continue;
    const auto other = std::ranges::lower_bound(candidates_, Candidate{f, pair.shape});
    if (other == candidates_.end() || *other != Candidate{f, pair.shape}) continue;
    const Side& side = sides_[static_cast<std::size_t>(other - candidates_.begin())];
    if (side.is_through) return side.sign * faces_[f].turn * face.turn;
  }
  return 0;
}

// After both moved from one state to another.
BladeContact::Standing BladeContact::standing(const RodModel& model, const RodState& from,
                                              const RodState& state, std::size_t candidate) const {
  const Candidate& pair = candidates_[candidate];
  Standing standing;
  if (!is_whole(model, state, pair)) return standing;
  const Face& face = faces_[pair.face];
  const CollisionShape& shape = model.shapes[pair.shape];
  const Corners now = corners_of(state, face.corners);
  const std::optional<Vec3> normal = normal_of(now);
  if (!normal) return standing;
  standing.normal_W = *normal;
  const Axis axis = axis_of(state, shape);
  const auto depth_of = [](const PartOver& part, int sign) {
    return std::max(-sign * part.height[0], -sign * part.height[1]);
  };
  int sign = sides_[candidate].sign;
  std::optional<PartOver> part = part_over(axis, now, *normal);
  if (!part && sign != 0) {
    part = part_over(axis, now, *normal, fold * face.inner, sign);
    if (part && !(depth_of(*part, sign) > 0.0)) part.reset();
  }
  if (!part) return standing;
  if (sign == 0) sign = side_in_patch(pair);
  if (sign == 0)
    sign = side_after(axis_of(from, shape), corners_of(from, face.corners), axis, now, *part);
  if (sign == 0) return standing;
  standing.depth = depth_of(*part, sign);
  standing.side = {sign, standing.depth >= -in_blade};
  return standing;
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
  old_candidates_.swap(candidates_);
  old_sides_.swap(sides_);
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
  keep_sides();
  reference_.resize(state.position.size());
  for (int e = 0; e < state.size(); ++e)
    reference_[e] = {place_of(state, e, model.elements[e].length), state.position[e]};
  start_is_covered_ = true;
}

// What is through stays a candidate, however deep it is.
void BladeContact::keep_sides() {
  for (std::size_t i = 0; i < old_sides_.size(); ++i)
    if (old_sides_[i].is_through) candidates_.push_back(old_candidates_[i]);
  std::ranges::sort(candidates_);
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  std::erase_if(candidates_,
                [&](const Candidate& pair) { return std::ranges::binary_search(left_out_, pair); });
  sides_.assign(candidates_.size(), {});
  std::size_t old = 0;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    while (old < old_candidates_.size() && old_candidates_[old] < candidates_[i]) ++old;
    if (old < old_candidates_.size() && old_candidates_[old] == candidates_[i])
      sides_[i] = old_sides_[old];
  }
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
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (is_whole(model, state, candidates_[i])) touch(model, state, dt, i, found);
}

// Where they touch, in which direction and how far apart their middles are; false: they do not.
bool BladeContact::place(const Axis& was, const Corners& were, const Axis& axis, const Corners& now,
                         double moved, const Candidate& pair, const Standing& standing,
                         Touch& touch) const {
  const auto between = [](const Axis& a, const Corners& b, const NearestToTriangle& at) {
    return Vec3(a.at(at.along) - place_on(b, at.shares));
  };
  // Moved back to its own side by more than it is beyond, what is nearest there goes back first.
  const auto go_back = [&](const Vec3& back) {
    touch.at = nearest_to_triangle({axis.near + back, axis.along}, now);
    const Vec3 way = between(axis, now, touch.at);
    touch.normal_W = (way + back).normalized();
    touch.gap = way.dot(touch.normal_W);
    return true;
  };
  const double beyond = std::max(moved, standing.depth) + in_blade;
  if (standing.side.is_through) return go_back(beyond * standing.side.sign * standing.normal_W);

  touch.at = nearest_to_triangle(axis, now);
  const Vec3 way = between(axis, now, touch.at);
  touch.gap = way.norm();
  touch.normal_W = way / touch.gap;
  const bool is_apart = touch.gap > in_blade;
  if (standing.side.sign != 0) return is_apart;
  // Beside a face, but through another one of the leaf: from there it goes back.
  if (const int sign = side_in_patch(pair); sign != 0)
    return is_apart && sign * way.dot(standing.normal_W) > 0.0;
  if (is_apart && way.dot(between(was, were, touch.at)) > 0.0) return true;
  // Across the rim since the step's start: towards where it was.
  const Vec3 side = between(was, were, nearest_to_triangle(was, were));
  return side.norm() > in_blade && go_back(beyond * side.normalized());
}

void BladeContact::touch(const RodModel& model, const RodState& state, double dt,
                         std::size_t candidate, std::vector<ContactPoint>& found) const {
  const Candidate& pair = candidates_[candidate];
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
  if (!sides_[candidate].is_through &&
      (std::min(near_end, far_end) > reach * area || std::max(near_end, far_end) < -reach * area))
    return;

  Touch touch;
  if (!place(was, were, axis, now, moved, pair, standing(model, *start_, state, candidate), touch))
    return;
  touch.radius = shape.radius_near + touch.at.along * (shape.radius_far - shape.radius_near);
  touch.back = shape.back_near + touch.at.along * (shape.back_far - shape.back_near);
  touch.gap -= touch.radius + blades.half_thickness();
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
