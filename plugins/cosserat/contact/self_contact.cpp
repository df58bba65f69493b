#include "pedicel/cosserat/contact/self_contact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pedicel/core/check.h"
#include "pedicel/cosserat/lanes/lane_access.h"

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

// A larger bound rebuilds the far list more rarely, but with more pairs.
ShapeMotion::Limits limits_of(const RodModel& model, const SelfContactSettings& settings) {
  double sum = 0.0;
  for (const CollisionShape& shape : model.shapes)
    sum += std::abs(shape.back_near - shape.back_far) + shape.radius_near + shape.radius_far;
  const double length = sum / static_cast<double>(std::max<std::size_t>(1, model.shapes.size()));
  ShapeMotion::Limits limits;
  limits.most = 2.0 * length;  // what moves farther in a step may pass through
  limits.margin = settings.margin;
  limits.skin = 0.3 * length;
  limits.near_share = 0.1;  // for what iterations change
  limits.far_share = 0.3;
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

double pair_stiffness(const SelfContactSettings& settings, bool is_fruit, double lighter,
                      double dt) {
  return std::min(is_fruit ? settings.fruit_stiffness : settings.stiffness, lighter / (dt * dt));
}

void add_pair(ContactPoint point, const ContactSide& a, const ContactSide& b, const Vec3& normal_W,
              std::vector<ContactPoint>& found) {
  const auto add = [&](const ContactSide& own, const ContactSide& other, const Vec3& normal) {
    point.shape = own.shape;
    point.collider = self_contact_base + other.shape;
    point.back = own.back;
    point.radius = own.radius;
    point.normal_W = normal;
    found.push_back(point);
  };
  add(a, b, normal_W);
  add(b, a, -normal_W);
}

SelfContact::SelfContact(const RodModel& model, const SelfContactSettings& settings,
                         std::span<const int> trees)
    : settings_(settings), motion_(model, limits_of(model, settings)) {
  check(settings);
  collect_left_out(model, trees);
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
  found_.clear();
  find_lists(model, state, dt, found_);
  for (std::size_t i = 0; i < found_.size(); ++i) found.push_back(found_[i]);
}

void SelfContact::find_lists(const RodModel& model, const RodState& state, double dt,
                             ContactLists& found) {
  // Without a step, as when contacts are only looked at, nothing has moved yet.
  if (!start_) begin_step(model, state, dt);
  const bool near_holds = update_lists(model, state);
  // One list of contacts a part: threads do not write beside each other, and the order of contacts
  // does not depend on them.
  const std::size_t first = found.add(far_parts_);
  loop_.each(far_parts_, [&](int part) {
    Scratch& scratch = scratch_[part];
    scratch.measured = 0;
    if (!near_holds) collect_near(part);
    touch_near(model, state, dt, scratch, found.list(first + part));
  });
  for (int part = 0; part < far_parts_; ++part) work_.pairs += scratch_[part].measured;
  if (!near_holds) share_out_far();
}

// Adds the contacts of a part of the near list.
void SelfContact::touch_near(const RodModel& model, const RodState& state, double dt,
                             Scratch& scratch, std::vector<ContactPoint>& found) const {
  const auto is_live = [&](const CollisionShape& shape) {
    return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]);
  };
  CapsulePairs& near = scratch.near;
  measure(motion_.now(), near);
  scratch.measured += static_cast<long>(near.size());
  // Pairs are touched eight at a time, in the order of the list.
  const std::size_t count = list_meeting(moved_capsules(), settings_.margin, near, scratch.meeting);
  TouchingRow row{};
  int lanes = 0;
  const auto touch_row = [&] {
    touch(motion_.start(), motion_.now(), *start_, state, row);
    for (int lane = 0; lane < lanes; ++lane) add_contact(model, dt, row, lane, found);
    lanes = 0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const int pair = scratch.meeting[i];
    const CollisionShape &a = model.shapes[near.a[pair]], &b = model.shapes[near.b[pair]];
    // What came off is no part of the plant any more.
    if (!is_live(a) || !is_live(b)) continue;
    row.a[lanes] = near.a[pair];
    row.b[lanes] = near.b[pair];
    row.element_a[lanes] = a.element;
    row.element_b[lanes] = b.element;
    row.at_a[lanes] = near.at_a[pair];
    row.at_b[lanes] = near.at_b[pair];
    row.back_a[lanes] = back_at(a, near.at_a[pair]);
    row.back_b[lanes] = back_at(b, near.at_b[pair]);
    if (++lanes == lane_count) touch_row();
  }
  if (lanes > 0) touch_row();
}

void SelfContact::add_contact(const RodModel& model, double dt, const TouchingRow& row, int lane,
                              std::vector<ContactPoint>& found) const {
  const double gap = row.gap[lane];
  // What is farther apart than it moved in this step is not met in the next iteration either.
  if (!(gap <= settings_.margin + row.apart[lane])) return;
  const int a = row.a[lane], b = row.b[lane];
  const CollisionShape &shape_a = model.shapes[a], &shape_b = model.shapes[b];
  const bool is_fruit = shape_a.fruit >= 0 || shape_b.fruit >= 0;
  const double lighter =
      std::min(model.elements[shape_a.element].mass, model.elements[shape_b.element].mass);
  ContactPoint point;
  point.gap = 0.5 * gap;
  point.stiffening = {pair_stiffness(settings_, is_fruit, lighter, dt), settings_.margin};
  take_tangent(point);
  point.friction = settings_.friction;
  point.surface_motion_W = vector_at(row.motion, lane);
  add_pair(point, {a, row.back_a[lane], row.radius_a[lane]},
           {b, row.back_b[lane], row.radius_b[lane]}, vector_at(row.normal, lane), found);
}

}  // namespace pedicel::cosserat
