#include "cosserat/self_contact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "cosserat/lanes.h"
#include "cosserat/rotation.h"

namespace pedicel::cosserat {

namespace {

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

// A larger budget collects the far list more rarely, but with more pairs.
ShapeMotion::Limits limits_of(const RodModel& model, const SelfContactSettings& settings) {
  double sum = 0.0;
  for (const CollisionShape& shape : model.shapes)
    sum += std::abs(shape.back_near - shape.back_far) + shape.radius_near + shape.radius_far;
  const double length = sum / static_cast<double>(std::max<std::size_t>(1, model.shapes.size()));
  ShapeMotion::Limits limits;
  limits.most = 2.0 * length;  // what moves farther in a step may pass through
  limits.margin = settings.margin;
  limits.skin = 0.3 * length;
  limits.slack = 0.1;  // for what iterations change
  limits.astray = 0.3;
  return limits;
}

}  // namespace

void take_tangent(ContactPoint& point) {
  const auto& [stiffness, margin] = point.stiffening;
  const double overlap = std::max(0.0, margin - 2.0 * point.gap);
  const double stiffening = std::min(overlap / margin, most_stiffening);
  const double force = stiffness * overlap * (1.0 + stiffening);
  point.stiffness =
      2.0 * stiffness * (1.0 + (stiffening < most_stiffening ? 2.0 : 1.0) * stiffening);
  point.margin = overlap > 0.0 ? point.gap + force / point.stiffness : 0.5 * margin;
}

SelfContact::SelfContact(const RodModel& model, const SelfContactSettings& settings)
    : settings_(settings), motion_(model, limits_of(model, settings)) {
  check(settings);
  collect_left_out(model);
  collect_far();
  work_ = {};
}

void SelfContact::change_settings(const SelfContactSettings& settings) {
  check(settings);
  if (settings.margin != settings_.margin)
    throw UsageError("SelfContactSettings.margin: must stay");
  settings_ = settings;
}

void SelfContact::begin_step(const RodModel&, const RodState& start, double) {
  start_ = &start;
  step_begins_ = true;
}

void SelfContact::find(const RodModel& model, const RodState& state, double dt,
                       std::vector<ContactPoint>& found) {
  if (!start_) begin_step(model, state, dt);
  look(model, state);
  const std::size_t count = near_.size();
  work_.pairs += static_cast<long>(count);
  const int parts = loop_.parts(count, worth_touching);
  loop_.run(count, parts, [&](int part, std::size_t first, std::size_t end) {
    touch_some(model, state, dt, part, first, end);
  });
  for (int part = 0; part < parts; ++part)
    found.insert(found.end(), scratch_[part].found.begin(), scratch_[part].found.end());
}

void SelfContact::touch_some(const RodModel& model, const RodState& state, double dt, int part,
                             std::size_t first, std::size_t end) {
  const auto is_live = [&](const CollisionShape& shape) {
    return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]);
  };
  Scratch& scratch = scratch_[part];
  scratch.found.clear();
  measure(motion_.now(), near_, first, end);
  const std::size_t meeting =
      list_meeting(moved_capsules(), settings_.margin, near_, first, end, scratch.meeting);
  for (std::size_t i = 0; i < meeting; ++i) {
    const int pair = scratch.meeting[i];
    if (is_live(model.shapes[near_.a[pair]]) && is_live(model.shapes[near_.b[pair]]))
      touch(model, state, dt, pair, scratch.found);
  }
}

void SelfContact::touch(const RodModel& model, const RodState& state, double dt, std::size_t pair,
                        std::vector<ContactPoint>& found) const {
  const int a = near_.a[pair], b = near_.b[pair];
  const double at_a = near_.at_a[pair], at_b = near_.at_b[pair];
  const CollisionShape &shape_a = model.shapes[a], &shape_b = model.shapes[b];
  const int element_a = shape_a.element, element_b = shape_b.element;
  const double back_a = back_at(shape_a, at_a), back_b = back_at(shape_b, at_b);
  const auto place_on = [](const Capsule& capsule, double at) -> Vec3 {
    return capsule.near_at() + at * (capsule.far_at() - capsule.near_at());
  };
  const Vec3 between_W = place_on(motion_.now()[a], at_a) - place_on(motion_.now()[b], at_b);
  double distance = between_W.norm();
  const double radius_a = shape_a.radius_near + at_a * (shape_a.radius_far - shape_a.radius_near);
  const double radius_b = shape_b.radius_near + at_b * (shape_b.radius_far - shape_b.radius_near);
  const Vec3 before_W = place_on(motion_.start()[a], at_a) - place_on(motion_.start()[b], at_b);
  Vec3 normal_W = distance > 0.0 ? Vec3(between_W / distance) : Vec3(Vec3::UnitZ());
  // Axes that went through each other in this step are pushed back to where they came from.
  if (before_W.dot(normal_W) < 0.0) {
    normal_W = -normal_W;
    distance = -distance;
  }
  const double gap = distance - radius_a - radius_b;
  const Vec3 motion_a = moved(state, element_a, back_a, -radius_a * normal_W);
  const Vec3 motion_b = moved(state, element_b, back_b, radius_b * normal_W);
  // What is farther apart than it moved in this step is not met in the next iteration either.
  if (!(gap <= settings_.margin + (motion_a - motion_b).norm())) return;

  ContactPoint point;
  const bool soft = shape_a.fruit >= 0 || shape_b.fruit >= 0;
  const double lighter = std::min(model.elements[element_a].mass, model.elements[element_b].mass);
  const double stiffness =
      std::min(soft ? settings_.fruit_stiffness : settings_.stiffness, lighter / (dt * dt));
  point.gap = 0.5 * gap;
  point.stiffening = {stiffness, settings_.margin};
  take_tangent(point);
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

// How far the material point moved over the step that lies `outward_W` from the axis now.
Vec3 SelfContact::moved(const RodState& state, int element, double back,
                        const Vec3& outward_W) const {
  const Quat& q = state.orientation[element];
  const Vec3 arm_W = outward_W - back * third_axis(q);
  return state.position[element] + arm_W - start_->position[element] -
         start_->orientation[element] * (q.conjugate() * arm_W);
}

}  // namespace pedicel::cosserat
