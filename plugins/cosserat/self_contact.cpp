#include "cosserat/self_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/check.h"

namespace pedicel::cosserat {

namespace {

using Box = Eigen::AlignedBox3d;
using Cell = std::array<int, 3>;

constexpr double midway = 1.0e-4;  // pull towards the middles, relative to the longer axis squared
// A larger budget collects pairs more rarely, but more of them.
constexpr double skin = 0.35;        // mean lengths of a shape
constexpr double steps_ahead = 4.0;  // of the present motion
constexpr double most_motion = 2.0;  // mean lengths: what moves farther in a step may pass through
constexpr double most_stiffening = 10.0;  // 1, of the progressive spring

double radius_at(const CollisionShape& shape, double fraction) {
  return shape.radius_near + fraction * (shape.radius_far - shape.radius_near);
}

double back_at(const CollisionShape& shape, double fraction) {
  return shape.back_near + fraction * (shape.back_far - shape.back_near);
}

// At most two joints apart: parent, grandparent, or sibling.
bool is_near_in_tree(const RodModel& model, int a, int b) {
  const auto parent = [&](int e) { return e < 0 ? -1 : model.elements[e].parent; };
  if (a == b || parent(a) == parent(b)) return true;
  return parent(a) == b || parent(b) == a || parent(parent(a)) == b || parent(parent(b)) == a;
}

bool is_near_in_graph(const RodModel& model, int a, int b) {
  if (is_near_in_tree(model, a, b)) return true;
  const auto joined = [&](int x, int y, const Weld& weld) {
    return (x == weld.a && is_near_in_tree(model, weld.b, y)) ||
           (x == weld.b && is_near_in_tree(model, weld.a, y));
  };
  return std::any_of(model.welds.begin(), model.welds.end(),
                     [&](const Weld& weld) { return joined(a, b, weld) || joined(b, a, weld); });
}

void check(const SelfContactSettings& settings) {
  const auto above = [](const char* name, double value, bool good, const char* bound) {
    if (!good)
      throw UsageError("SelfContactSettings." + std::string(name) + " = " + std::to_string(value) +
                       ": must be " + bound);
  };
  above("stiffness", settings.stiffness, settings.stiffness > 0.0, "> 0");
  above("fruit_stiffness", settings.fruit_stiffness, settings.fruit_stiffness > 0.0, "> 0");
  above("friction", settings.friction, settings.friction >= 0.0, ">= 0");
  above("margin", settings.margin, settings.margin > 0.0, "> 0");
}

// A grid whose cells are about as large as the boxes, yet no box spans more than some ten of them.
struct Grid {
  Vec3 origin = Vec3::Zero();
  double size = 1.0;

  explicit Grid(std::span<const Box> boxes) {
    Box all;
    double sum = 0.0, largest = 0.0;
    int count = 0;
    for (const Box& box : boxes) {
      if (box.isEmpty()) continue;
      const double extent = box.sizes().maxCoeff();
      all.extend(box);
      sum += extent;
      largest = std::max(largest, extent);
      ++count;
    }
    if (count == 0) return;
    origin = all.min();
    // 2^20 cells along each axis fit into a key.
    size = std::max({2.0 * sum / count, largest / 8.0, all.sizes().maxCoeff() / 1.0e6, 1.0e-9});
  }

  Cell cell(const Vec3& point) const {
    const Vec3 scaled = (point - origin) / size;
    return {static_cast<int>(scaled.x()), static_cast<int>(scaled.y()),
            static_cast<int>(scaled.z())};
  }

  std::uint64_t key(const Vec3& point) const { return key(cell(point)); }
  static std::uint64_t key(const Cell& cell) {
    return (static_cast<std::uint64_t>(cell[0]) << 42) |
           (static_cast<std::uint64_t>(cell[1]) << 21) | static_cast<std::uint64_t>(cell[2]);
  }
};

}  // namespace

NearestFractions nearest_fractions(const Vec3& start_a, const Vec3& along_a, const Vec3& start_b,
                                   const Vec3& along_b) {
  const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  const double pull = midway * std::max(aa, bb) + 1.0e-18;
  const Vec3 between = start_a - start_b;
  // Setting the derivatives by s and t to zero:
  //   (aa + pull) s - ab t = right_s,   (bb + pull) t - ab s = right_t
  const double left_s = aa + pull, left_t = bb + pull;
  const double right_s = 0.5 * pull - along_a.dot(between);
  const double right_t = 0.5 * pull + along_b.dot(between);
  const double determinant = left_s * left_t - ab * ab;
  const double s = (right_s * left_t + ab * right_t) / determinant;
  const double t = (right_t * left_s + ab * right_s) / determinant;
  if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) return {s, t};

  // The minimum lies on the square's edge.
  const auto best_s = [&](double fixed) {
    return std::clamp((right_s + ab * fixed) / left_s, 0.0, 1.0);
  };
  const auto best_t = [&](double fixed) {
    return std::clamp((right_t + ab * fixed) / left_t, 0.0, 1.0);
  };
  const NearestFractions edges[] = {
      {0.0, best_t(0.0)}, {1.0, best_t(1.0)}, {best_s(0.0), 0.0}, {best_s(1.0), 1.0}};
  const auto cost = [&](const NearestFractions& f) {
    return f.a * (0.5 * left_s * f.a - right_s) + f.b * (0.5 * left_t * f.b - right_t) -
           ab * f.a * f.b;
  };
  return *std::min_element(std::begin(edges), std::end(edges),
                           [&](const auto& x, const auto& y) { return cost(x) < cost(y); });
}

void OverlappingBoxes::find(std::span<const Box> boxes, std::vector<std::pair<int, int>>& pairs) {
  pairs.clear();
  entries_.clear();
  const Grid grid(boxes);
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    if (boxes[i].isEmpty()) continue;
    const Cell low = grid.cell(boxes[i].min()), high = grid.cell(boxes[i].max());
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z) entries_.push_back({Grid::key(Cell{x, y, z}), i});
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.box < b.box;
  });
  for (std::size_t i = 0; i < entries_.size(); ++i)
    for (std::size_t j = i + 1; j < entries_.size() && entries_[j].cell == entries_[i].cell; ++j) {
      const Box& a = boxes[entries_[i].box];
      const Box& b = boxes[entries_[j].box];
      if (a.intersects(b) && grid.key(a.min().cwiseMax(b.min())) == entries_[i].cell)
        pairs.emplace_back(entries_[i].box, entries_[j].box);
    }
  std::sort(pairs.begin(), pairs.end());
}

SelfContact::SelfContact(const RodModel& model, const SelfContactSettings& settings)
    : settings_(settings), bodies_(model.elements.size()), boxes_(model.shapes.size()) {
  check(settings);
  double sum = 0.0;
  for (const CollisionShape& shape : model.shapes) {
    sum += std::abs(shape.back_near - shape.back_far) + 2.0 * radius_at(shape, 0.5);
    Body& body = bodies_[shape.element];
    body.middle_back = 0.5 * model.elements[shape.element].length;
    body.lever =
        std::max({body.lever, std::abs(shape.back_near - body.middle_back) + shape.radius_near,
                  std::abs(shape.back_far - body.middle_back) + shape.radius_far});
  }
  extent_ = sum / static_cast<double>(std::max<std::size_t>(1, model.shapes.size()));
  const RodState drawn = drawn_state(model);
  begin_step(model, drawn, 0.0);
  move_bodies(drawn);
  collect_pairs(model, drawn);
  const auto touches = [&](const Pair& pair) {
    return nearest(model, drawn, pair.a, pair.b).gap() < settings_.margin;
  };
  for (const Pair& pair : pairs_)
    if (touches(pair)) excluded_.emplace_back(pair.a, pair.b);
  std::sort(excluded_.begin(), excluded_.end());
  std::erase_if(pairs_, touches);
  work_ = {};
}

void SelfContact::change_settings(const SelfContactSettings& settings) {
  check(settings);
  if (settings.margin != settings_.margin)
    throw UsageError("SelfContactSettings.margin: must stay");
  settings_ = settings;
}

void SelfContact::begin_step(const RodModel&, const RodState& start, double) {
  start_position_ = start.position;
  start_orientation_ = start.orientation;
}

SelfContact::Axis SelfContact::axis_of(const CollisionShape& shape, const RodState& state) {
  const Vec3 axis = state.orientation[shape.element] * Vec3::UnitZ();
  return {state.position[shape.element] - shape.back_near * axis,
          (shape.back_near - shape.back_far) * axis};
}

// A place at most r from an element's middle moves against it by at most 2 r sin(angle / 2), and
// sin^2(angle / 2) = 1 - (q . q')^2.
void SelfContact::move_bodies(const RodState& state) {
  const double most = most_motion * extent_;
  for (std::size_t e = 0; e < bodies_.size(); ++e) {
    Body& body = bodies_[e];
    const Quat &q = state.orientation[e], &start = start_orientation_[e];
    body.middle = state.position[e] - body.middle_back * (q * Vec3::UnitZ());
    body.moved = body.middle - start_position_[e] + body.middle_back * (start * Vec3::UnitZ());
    const double far = body.moved.norm();
    if (far > most) body.moved *= most / far;
    const double cosine = q.coeffs().dot(start.coeffs());
    body.turned = 2.0 * body.lever * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  }
}

bool SelfContact::pairs_hold(const RodState& state) const {
  for (std::size_t e = 0; e < bodies_.size(); ++e) {
    const Body& body = bodies_[e];
    const double cosine = state.orientation[e].coeffs().dot(body.reference_orientation.coeffs());
    const double turned = 2.0 * body.lever * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double moved = (body.middle - body.reference).norm() + turned;
    if (moved + body.moved.norm() + body.turned > body.budget) return false;
  }
  return true;
}

void SelfContact::collect_pairs(const RodModel& model, const RodState& state) {
  ++work_.collections;
  for (std::size_t e = 0; e < bodies_.size(); ++e) {
    Body& body = bodies_[e];
    body.reference = body.middle;
    body.reference_orientation = state.orientation[e];
    body.budget = skin * extent_ + steps_ahead * (body.moved.norm() + body.turned);
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const CollisionShape& shape = model.shapes[i];
    const Axis axis = axis_of(shape, state);
    boxes_[i].setEmpty();
    if (!std::isfinite(axis.near.sum() + axis.along.sum())) continue;
    boxes_[i].extend(axis.near).extend(axis.near + axis.along);
    const double reach = std::max(shape.radius_near, shape.radius_far) + 0.5 * settings_.margin +
                         bodies_[shape.element].budget;
    boxes_[i].min().array() -= reach;
    boxes_[i].max().array() += reach;
  }
  overlapping_.find(boxes_, candidates_);
  pairs_.clear();
  for (const auto& [a, b] : candidates_) {
    const int element_a = model.shapes[a].element, element_b = model.shapes[b].element;
    const Body &first = bodies_[element_a], &second = bodies_[element_b];
    const double reach =
        first.lever + second.lever + settings_.margin + first.budget + second.budget;
    if ((first.middle - second.middle).squaredNorm() > reach * reach) continue;
    if (is_near_in_graph(model, element_a, element_b)) continue;
    if (std::binary_search(excluded_.begin(), excluded_.end(), std::pair(a, b))) continue;
    pairs_.push_back({a, b, element_a, element_b});
  }
}

SelfContact::Touch SelfContact::nearest(const RodModel& model, const RodState& state, int a,
                                        int b) {
  const CollisionShape &shape_a = model.shapes[a], &shape_b = model.shapes[b];
  const Axis first = axis_of(shape_a, state), second = axis_of(shape_b, state);
  const auto at = nearest_fractions(first.near, first.along, second.near, second.along);
  Touch touch;
  touch.back_a = back_at(shape_a, at.a);
  touch.back_b = back_at(shape_b, at.b);
  touch.radius_a = radius_at(shape_a, at.a);
  touch.radius_b = radius_at(shape_b, at.b);
  touch.between_W = first.near + at.a * first.along - second.near - at.b * second.along;
  return touch;
}

void SelfContact::find(const RodModel& model, const RodState& state, double dt,
                       std::vector<ContactPoint>& found) {
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  move_bodies(state);
  if (!pairs_hold(state)) collect_pairs(model, state);
  const auto is_live = [&](const CollisionShape& shape) {
    return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]);
  };
  for (const Pair& pair : pairs_) {
    // On the whole way of this step the two middles are not nearer than now less what they have
    // moved against each other, nor are any of their places.
    const Body &a = bodies_[pair.element_a], &b = bodies_[pair.element_b];
    const double reach =
        a.lever + b.lever + settings_.margin + a.turned + b.turned + (a.moved - b.moved).norm();
    if ((a.middle - b.middle).squaredNorm() > reach * reach) continue;
    ++work_.pairs;
    if (is_live(model.shapes[pair.a]) && is_live(model.shapes[pair.b]))
      touch(model, state, dt, pair.a, pair.b, found);
  }
}

void SelfContact::touch(const RodModel& model, const RodState& state, double dt, int a, int b,
                        std::vector<ContactPoint>& found) const {
  const Touch touch = nearest(model, state, a, b);
  const int element_a = model.shapes[a].element, element_b = model.shapes[b].element;
  const Body &body_a = bodies_[element_a], &body_b = bodies_[element_b];
  double distance = touch.between_W.norm();
  if (distance - touch.radius_a - touch.radius_b >
      settings_.margin + body_a.turned + body_b.turned + (body_a.moved - body_b.moved).norm())
    return;
  const Vec3 before_W = start_place(element_a, Vec3(0, 0, -touch.back_a)) -
                        start_place(element_b, Vec3(0, 0, -touch.back_b));
  Vec3 normal_W = distance > 0.0 ? Vec3(touch.between_W / distance) : Vec3(Vec3::UnitZ());
  // Axes that went through each other in this step are pushed back to where they came from.
  if (before_W.dot(normal_W) < 0.0) {
    normal_W = -normal_W;
    distance = -distance;
  }
  const double gap = distance - touch.radius_a - touch.radius_b;
  const Vec3 motion_a = motion(state, element_a, touch.back_a, -touch.radius_a * normal_W);
  const Vec3 motion_b = motion(state, element_b, touch.back_b, touch.radius_b * normal_W);
  // What is farther apart than it moved in this step is not met in the next iteration either.
  if (!(gap <= settings_.margin + (motion_a - motion_b).norm())) return;

  ContactPoint point;
  const bool soft = model.shapes[a].fruit >= 0 || model.shapes[b].fruit >= 0;
  const double lighter = std::min(model.elements[element_a].mass, model.elements[element_b].mass);
  const double stiffness =
      std::min(soft ? settings_.fruit_stiffness : settings_.stiffness, lighter / (dt * dt));
  const double overlap = std::max(0.0, settings_.margin - gap);
  const double stiffening = std::min(overlap / settings_.margin, most_stiffening);
  const double force = stiffness * overlap * (1.0 + stiffening);
  // The progressive spring's tangent: the same force and slope at this iterate.
  point.stiffness =
      2.0 * stiffness * (1.0 + (stiffening < most_stiffening ? 2.0 : 1.0) * stiffening);
  point.gap = 0.5 * gap;
  point.margin = overlap > 0.0 ? point.gap + force / point.stiffness : 0.5 * settings_.margin;
  point.friction = settings_.friction;
  point.surface_motion_W = 0.5 * (motion_a + motion_b);
  const auto add = [&](int shape, int other, double back, double radius, const Vec3& normal) {
    point.shape = shape;
    point.collider = self_contact_base + other;
    point.back = back;
    point.radius = radius;
    point.normal_W = normal;
    found.push_back(point);
  };
  add(a, b, touch.back_a, touch.radius_a, normal_W);
  add(b, a, touch.back_b, touch.radius_b, -normal_W);
}

Vec3 SelfContact::start_place(int element, const Vec3& arm_E) const {
  return start_position_[element] + start_orientation_[element] * arm_E;
}

// How far the material point moved over the step that lies `outward_W` from the axis now.
Vec3 SelfContact::motion(const RodState& state, int element, double back,
                         const Vec3& outward_W) const {
  const Quat& q = state.orientation[element];
  const Vec3 arm_E = Vec3(0, 0, -back) + q.conjugate() * outward_W;
  return state.position[element] + q * arm_E - start_place(element, arm_E);
}

}  // namespace pedicel::cosserat
