#include "cosserat/self_contact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"

namespace pedicel::cosserat {

namespace {

constexpr double most_stiffening = 10.0;  // 1, of the progressive spring

double back_at(const CollisionShape& shape, double fraction) {
  return shape.back_near + fraction * (shape.back_far - shape.back_near);
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

}  // namespace

SelfContact::SelfContact(const RodModel& model, const SelfContactSettings& settings)
    : settings_(settings), boxes_(model.shapes.size()) {
  check(settings);
  const std::size_t count = model.shapes.size();
  for (Capsules* capsules : {&start_, &now_}) capsules->resize(count);
  for (std::vector<double>* values : {&way_, &reach_, &far_.budget, &near_.budget})
    values->assign(count, 0.0);
  for (const CollisionShape& shape : model.shapes)
    lineage_.push_back(lineage(model, shape.element));
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const CollisionShape& shape = model.shapes[i];
    now_.radius_near[i] = start_.radius_near[i] = shape.radius_near;
    now_.radius_far[i] = start_.radius_far[i] = shape.radius_far;
    sum += std::abs(shape.back_near - shape.back_far) + shape.radius_near + shape.radius_far;
  }
  extent_ = sum / static_cast<double>(std::max<std::size_t>(1, count));
  const RodState drawn = drawn_state(model);
  begin_step(model, drawn, 0.0);
  now_ = start_;
  measure_ways();
  first_excluded_.assign(count + 1, 0);
  collect_far(model);
  exclude_touching();
  collect_far(model);
  work_ = {};
}

void SelfContact::change_settings(const SelfContactSettings& settings) {
  check(settings);
  if (settings.margin != settings_.margin)
    throw UsageError("SelfContactSettings.margin: must stay");
  settings_ = settings;
}

void SelfContact::begin_step(const RodModel& model, const RodState& start, double) {
  start_position_ = start.position;
  start_orientation_ = start.orientation;
  place(model, start, start_);
  near_list_made_ = false;
}

void SelfContact::find(const RodModel& model, const RodState& state, double dt,
                       std::vector<ContactPoint>& found) {
  if (start_position_.size() != state.position.size()) begin_step(model, state, dt);
  place(model, state, now_);
  if (!near_list_holds()) collect_near(model);
  measure(now_, near_.pairs, loop_);
  work_.pairs += static_cast<long>(near_.pairs.size());
  const std::size_t count = near_.pairs.size();
  const int parts = loop_.parts(count, worth_waking);
  loop_.run(count, parts, [&](int part, std::size_t first, std::size_t end) {
    found_[part].clear();
    touch_some(model, state, dt, first, end, found_[part]);
  });
  for (int part = 0; part < parts; ++part)
    found.insert(found.end(), found_[part].begin(), found_[part].end());
}

void SelfContact::touch_some(const RodModel& model, const RodState& state, double dt,
                             std::size_t first, std::size_t end,
                             std::vector<ContactPoint>& found) const {
  const auto is_live = [&](const CollisionShape& shape) {
    return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]);
  };
  for (std::size_t i = first; i < end; ++i) {
    const int a = near_.pairs.a[i], b = near_.pairs.b[i];
    const double over = near_.pairs.gap[i] - settings_.margin;
    if (over > way_[a] + way_[b] + near_.budget[a] + near_.budget[b]) continue;
    if (over > moved_apart(a, b)) continue;
    if (is_live(model.shapes[a]) && is_live(model.shapes[b])) touch(model, state, dt, i, found);
  }
}

void SelfContact::touch(const RodModel& model, const RodState& state, double dt, std::size_t pair,
                        std::vector<ContactPoint>& found) const {
  const int a = near_.pairs.a[pair], b = near_.pairs.b[pair];
  const double at_a = near_.pairs.at_a[pair], at_b = near_.pairs.at_b[pair];
  const CollisionShape &shape_a = model.shapes[a], &shape_b = model.shapes[b];
  const int element_a = shape_a.element, element_b = shape_b.element;
  const double back_a = back_at(shape_a, at_a), back_b = back_at(shape_b, at_b);
  const Vec3 between_W = now_.near_at(a) + at_a * (now_.far_at(a) - now_.near_at(a)) -
                         now_.near_at(b) - at_b * (now_.far_at(b) - now_.near_at(b));
  double distance = between_W.norm();
  const double radius_a = shape_a.radius_near + at_a * (shape_a.radius_far - shape_a.radius_near);
  const double radius_b = shape_b.radius_near + at_b * (shape_b.radius_far - shape_b.radius_near);
  const Vec3 before_W =
      start_place(element_a, Vec3(0, 0, -back_a)) - start_place(element_b, Vec3(0, 0, -back_b));
  Vec3 normal_W = distance > 0.0 ? Vec3(between_W / distance) : Vec3(Vec3::UnitZ());
  // Axes that went through each other in this step are pushed back to where they came from.
  if (before_W.dot(normal_W) < 0.0) {
    normal_W = -normal_W;
    distance = -distance;
  }
  const double gap = distance - radius_a - radius_b;
  const Vec3 motion_a = motion(state, element_a, back_a, -radius_a * normal_W);
  const Vec3 motion_b = motion(state, element_b, back_b, radius_b * normal_W);
  // What is farther apart than it moved in this step is not met in the next iteration either.
  if (!(gap <= settings_.margin + (motion_a - motion_b).norm())) return;

  ContactPoint point;
  const bool soft = shape_a.fruit >= 0 || shape_b.fruit >= 0;
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
  add(a, b, back_a, radius_a, normal_W);
  add(b, a, back_b, radius_b, -normal_W);
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
