#include "plugins/discrepancy/simulate/grip.h"

#include <algorithm>
#include <cmath>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {
constexpr double rounding = 1.0e-9;  // s, of a step that begins with a jump
/// Times the stiffness of the held segment's joint: turns as stiffly as a plant's own supports do.
constexpr double turning = 100.0;

// What an effect alone makes of a grip.
effects::GripState state_of(const plant::Effect& effect) {
  effects::GripState grip;
  effects::apply_to_grip(effect, grip);
  return grip;
}

}  // namespace

std::vector<double> slip_times(std::span<const plant::Effect> all) {
  std::vector<double> times;
  for (const plant::Effect& effect : all)
    if (const double time = state_of(effect).slip_time; std::isfinite(time)) times.push_back(time);
  return times;
}

Grip::Grip(const PlantMaker& maker, const cosserat::RodModel& model, const Trial& trial,
           std::span<const plant::Effect> all) {
  for (const Hold& hold : trial.holds) {
    Held held;
    held.hold = &hold;
    held.place = held.slipped = maker.locate(hold.place);
    held.stiffness = hold.stiffness.value_or(rigid_stiffness);
    for (const plant::Effect& effect : all) {
      effects::GripState grip{.stiffness = held.stiffness};
      effects::apply_to_grip(effect, grip);
      held.stiffness = grip.stiffness;
      if (!std::isfinite(grip.slip_time)) continue;
      held.slipped = maker.locate_beyond(hold.place, grip.slip_distance);
      held.slip_time = grip.slip_time;
    }
    held.drawn[0] = model.elements[held.place.element].drawn_rotation;
    held.drawn[1] = model.elements[held.slipped.element].drawn_rotation;
    held.bend_stiffness = turning * model.elements[held.place.element].bend_stiffness;
    held_.push_back(held);
  }
}

bool Grip::holds(const Held& held, double begin) const {
  return begin < held.hold->release - rounding;
}

const plant::PlacedPoint& Grip::place(const Held& held, double begin) const {
  return begin >= held.slip_time - rounding ? held.slipped : held.place;
}

cosserat::Support Grip::support(const Held& held, double begin, double t) const {
  const bool slipped = begin >= held.slip_time - rounding;
  cosserat::Support support;
  support.element = place(held, begin).element;
  support.back = place(held, begin).back;
  support.position = held.hold->path.position_at(t);
  if (!held.hold->slides()) support.position_stiffness = held.stiffness;
  if (held.hold->path.rotation.empty()) return support;
  support.rotation = held.hold->path.rotation_at(t) * held.drawn[slipped ? 1 : 0];
  support.rotation_stiffness = held.bend_stiffness;
  if (held.hold->direction) support.rotation_stiffness.z() = 0.0;  // its twist is free
  return support;
}

void Grip::add_guides(const Held& held, double begin, double t, std::vector<Guide>& guides) const {
  for (const Vec3& axis : held.hold->axes) {
    Guide guide;
    guide.element = place(held, begin).element;
    guide.back = place(held, begin).back;
    guide.axis = axis;
    guide.one_sided = held.hold->one_sided;
    guide.stiffness = held.stiffness;
    guide.target = held.hold->path.position_at(t);
    guide.before = held.hold->path.position_at(begin);
    guides.push_back(guide);
  }
}

void Grip::add_supports(double begin, double t, std::vector<cosserat::Support>& supports) const {
  for (const Held& held : held_)
    if (holds(held, begin) && (!held.hold->slides() || !held.hold->path.rotation.empty()))
      supports.push_back(support(held, begin, t));
}

void Grip::add_guides(double begin, double t, std::vector<Guide>& guides) const {
  for (const Held& held : held_)
    if (holds(held, begin)) add_guides(held, begin, t, guides);
}

bool Grip::has_guides() const {
  return std::ranges::any_of(held_, [](const Held& held) { return held.hold->slides(); });
}

Vec3 Grip::force(const cosserat::RodModel& model, const cosserat::RodState& state, double begin,
                 double t) const {
  if (held_.empty() || !holds(held_.front(), begin)) return Vec3::Zero();
  if (held_.front().hold->slides()) {
    std::vector<Guide> guides;
    add_guides(held_.front(), begin, t, guides);
    Vec3 sum = Vec3::Zero();
    for (const Guide& guide : guides) sum += force_of(guide, model, state);
    return sum;
  }
  const cosserat::Support spring = support(held_.front(), begin, t);
  if (!state.alive[spring.element]) return Vec3::Zero();  // it holds a fruit that came off
  const Vec3 axis = state.orientation[spring.element] * Vec3::UnitZ();
  const Vec3 point = state.position[spring.element] - spring.back * axis;
  return spring.position_stiffness * (spring.position - point);
}

}  // namespace pedicel::discrepancy
