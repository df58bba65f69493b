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
    : settings_(settings), bodies_(model.shapes.size()), fat_boxes_(model.shapes.size()) {
  check(settings);
  place_bodies(model, drawn_state(model));
  double extent = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    extent += bodies_[i].along.norm() + 2.0 * radius_at(model.shapes[i], 0.5);
  skin_ = 0.1 * extent / std::max<std::size_t>(1, bodies_.size());
  rebuild_pairs(model);
  exclude(model);
  rebuild_pairs(model);
}

void SelfContact::begin_step(const RodModel&, const RodState& start, double) {
  start_position_ = start.position;
  start_orientation_ = start.orientation;
}

void SelfContact::place_bodies(const RodModel& model, const RodState& state) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const CollisionShape& shape = model.shapes[i];
    const Vec3 axis = state.orientation[shape.element] * Vec3::UnitZ();
    bodies_[i].near = state.position[shape.element] - shape.back_near * axis;
    bodies_[i].along = (shape.back_near - shape.back_far) * axis;
    bodies_[i].live = state.alive[shape.element] &&
                      (shape.fruit < 0 || !state.fruit_gone[shape.fruit]) &&
                      std::isfinite(bodies_[i].near.sum() + axis.sum());
  }
}

Box SelfContact::box_around(const CollisionShape& shape, const Body& body, double more) const {
  const double reach =
      std::max(shape.radius_near, shape.radius_far) + 0.5 * settings_.margin + more;
  Box box(body.near.cwiseMin(body.near + body.along), body.near.cwiseMax(body.near + body.along));
  box.min().array() -= reach;
  box.max().array() += reach;
  return box;
}

bool SelfContact::pairs_hold(const RodModel& model) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].live && !fat_boxes_[i].contains(box_around(model.shapes[i], bodies_[i], 0.0)))
      return false;
  return true;
}

void SelfContact::rebuild_pairs(const RodModel& model) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    fat_boxes_[i].setEmpty();
    if (bodies_[i].live) fat_boxes_[i] = box_around(model.shapes[i], bodies_[i], skin_);
  }
  overlapping_.find(fat_boxes_, pairs_);
  std::erase_if(pairs_, [&](const auto& pair) {
    return std::binary_search(excluded_.begin(), excluded_.end(), pair) ||
           is_near_in_graph(model, model.shapes[pair.first].element,
                            model.shapes[pair.second].element);
  });
}

void SelfContact::exclude(const RodModel& model) {
  for (const auto& [a, b] : pairs_)
    if (nearest(model, a, b).gap() < settings_.margin) excluded_.emplace_back(a, b);
}

SelfContact::Touch SelfContact::nearest(const RodModel& model, int a, int b) const {
  const Body &first = bodies_[a], &second = bodies_[b];
  const auto at = nearest_fractions(first.near, first.along, second.near, second.along);
  Touch touch;
  touch.back_a = back_at(model.shapes[a], at.a);
  touch.back_b = back_at(model.shapes[b], at.b);
  touch.radius_a = radius_at(model.shapes[a], at.a);
  touch.radius_b = radius_at(model.shapes[b], at.b);
  touch.between_W = first.near + at.a * first.along - second.near - at.b * second.along;
  return touch;
}

void SelfContact::find(const RodModel& model, const RodState& state, double dt,
                       std::vector<ContactPoint>& found) {
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  place_bodies(model, state);
  if (!pairs_hold(model)) rebuild_pairs(model);
  for (const auto& [a, b] : pairs_)
    if (bodies_[a].live && bodies_[b].live) touch(model, state, dt, a, b, found);
}

void SelfContact::touch(const RodModel& model, const RodState& state, double dt, int a, int b,
                        std::vector<ContactPoint>& found) const {
  const Touch touch = nearest(model, a, b);
  const int element_a = model.shapes[a].element, element_b = model.shapes[b].element;
  const Vec3 before_W = start_place(element_a, Vec3(0, 0, -touch.back_a)) -
                        start_place(element_b, Vec3(0, 0, -touch.back_b));
  double distance = touch.between_W.norm();
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
  const double force = stiffness * overlap * (1.0 + overlap / settings_.margin);
  // The progressive spring's tangent: the same force and slope at this iterate.
  point.stiffness = 2.0 * stiffness * (1.0 + 2.0 * overlap / settings_.margin);
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
