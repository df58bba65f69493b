#include "tests/stress/energy_ledger.h"

#include <algorithm>

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/model/rotation.h"

namespace pedicel::stress {

using cosserat::ContactForce;
using cosserat::Element;
using cosserat::RodModel;
using cosserat::RodState;
using cosserat::Strain;

namespace {

// J: below this, rounding is all there is.
constexpr double rounding = 1.0e-12;

Vec3 turn_between(const Quat& before, const Quat& after) {
  return cosserat::log_map(after * before.conjugate());
}

// A place fixed to a segment, as rigid as the segment's mass.
Vec3 place(const RodState& state, int element, double back) {
  return state.position[element] - back * (state.orientation[element] * Vec3::UnitZ());
}

double spring_energy(const ContactForce& contact) {
  return (contact.normal * contact.normal + contact.tangential_W.squaredNorm()) /
         (2.0 * contact.point.stiffness);
}

double collider_work(const ContactForce& contact, bool is_converged) {
  if (cosserat::is_self_contact(contact.point.collider)) return 0.0;
  const Vec3& moved = contact.point.surface_motion_W;
  if (!is_converged) return contact.tangential_W.norm() * moved.norm();
  return (contact.normal * contact.point.normal_W + contact.tangential_W).dot(moved);
}

double load_work(const cosserat::Load& load, const BookedStep& step) {
  const int e = load.element;
  if (!step.before.alive[e]) return 0.0;
  const Vec3 moved = place(step.after, e, load.back) - place(step.before, e, load.back);
  return load.force_W.dot(moved) +
         load.moment_W.dot(turn_between(step.before.orientation[e], step.after.orientation[e]));
}

// J, kinetic + elastic + in gravity, of what came off: a tip with its fruit, or the fruit alone.
double taken(const RodModel& model, const RodState& after, const Vec3& gravity,
             const cosserat::DetachEvent& event) {
  const cosserat::Fruit& fruit = model.fruits[event.fruit];
  if (event.stub_length > 0.0) {
    RodState whole = after;
    whole.alive[fruit.element] = 1;
    return cosserat::energy_of(model, whole, gravity).total() -
           cosserat::energy_of(model, after, gravity).total();
  }
  const double inertia = 0.4 * event.mass * fruit.radius * fruit.radius;
  return 0.5 * event.mass * event.velocity_W.squaredNorm() +
         0.5 * inertia * event.angular_velocity_W.squaredNorm() -
         event.mass * gravity.dot(place(after, fruit.element, fruit.back));
}

}  // namespace

EnergyLedger::EnergyLedger(const RodModel& model, const RodState& start, const Vec3& gravity,
                           cosserat::Integrator integrator)
    : gravity_(gravity), is_second_order_(integrator == cosserat::Integrator::bdf2) {
  for (int e = 0; e < model.size(); ++e)
    if (model.elements[e].parent < 0)
      roots_.push_back({e, cosserat::strain_of(model, start, e), {}});
  const cosserat::Energy energy = cosserat::energy_of(model, start, gravity);
  work_ = energy.total();
  found_ = put_in_ = largest_ = energy.kinetic + energy.elastic;
}

double EnergyLedger::slack() const {
  return std::max(largest_, 0.0) + rounding;
}

// The scheme's own rate at the end of a step.
Vec3 EnergyLedger::rate(const Vec3& change, const Vec3& change_before, double dt) const {
  if (!is_second_order_ || !has_history_) return change / dt;
  return (1.5 * change - 0.5 * change_before) / dt;
}

// The clamp feels force and moment of the segments that start there, with their damping.
double EnergyLedger::clamp_work(const RodModel& model, const BookedStep& step) {
  const Vec3 shift = step.after.root.position - step.before.root.position;
  const Vec3 turn = turn_between(step.before.root.rotation, step.after.root.rotation);
  double work = 0.0;
  for (Root& root : roots_) {
    const Element& element = model.elements[root.element];
    const Strain now = cosserat::strain_of(model, step.after, root.element);
    const Strain change = {now.stretch - root.strain.stretch, now.bend - root.strain.bend};
    const Vec3 stretch_rate = rate(change.stretch, root.change.stretch, step.dt);
    const Vec3 bend_rate = rate(change.bend, root.change.bend, step.dt);
    const Vec3 force =
        element.stretch_stiffness.cwiseProduct(now.stretch + element.damping_time * stretch_rate);
    const Vec3 moment =
        cosserat::inverse_right_jacobian(now.bend).transpose() *
        element.bend_stiffness.cwiseProduct(now.bend + element.damping_time * bend_rate);
    const Quat& q = step.after.orientation[root.element];
    if (step.before.alive[root.element])
      work += step.is_converged ? -(q * force).dot(shift) - (q * moment).dot(turn)
                                : pressed_by_clamp(model, step, root);
    root.strain = now;
    root.change = change;
  }
  has_history_ = true;
  return work;
}

double EnergyLedger::pressed_by_clamp(const RodModel& model, const BookedStep& step,
                                      const Root& root) const {
  const Element& element = model.elements[root.element];
  RodState held = step.before;
  held.root = step.after.root;
  const Strain strain = cosserat::strain_of(model, held, root.element);
  const auto pressed = [&](const Vec3& stiffness, const Vec3& before, const Vec3& now) {
    const Vec3 change = now - before;
    return 0.5 *
           (now.dot(stiffness.cwiseProduct(now)) - before.dot(stiffness.cwiseProduct(before)) +
            element.damping_time / step.dt * change.dot(stiffness.cwiseProduct(change)));
  };
  return std::max(0.0, element.length * pressed(element.stretch_stiffness, root.strain.stretch,
                                                strain.stretch) +
                           pressed(element.bend_stiffness, root.strain.bend, strain.bend));
}

double EnergyLedger::pressed_by_colliders(const BookedStep& step) const {
  double pressed = 0.0;
  for (const auto& met : {step.meeting_half_way, step.meeting})
    for (const cosserat::ContactPoint& point : met) {
      const double overlap = std::max(0.0, point.margin - point.gap);
      const double friction = point.friction * point.stiffness * overlap;
      pressed +=
          0.5 * point.stiffness * overlap * overlap + friction * point.surface_motion_W.norm();
    }
  return std::max(0.0, pressed - springs_);
}

void EnergyLedger::book(const RodModel& model, const BookedStep& step) {
  double springs = 0.0;
  for (const ContactForce& contact : step.contacts) {
    springs += spring_energy(contact);
    work_ += collider_work(contact, step.is_converged);
  }
  for (const cosserat::Load& load : step.loads) work_ += load_work(load, step);
  for (const cosserat::DetachEvent& event : step.detached)
    work_ -= taken(model, step.after, gravity_, event);
  work_ += clamp_work(model, step);
  if (!step.is_converged) work_ += pressed_by_colliders(step);
  const cosserat::Energy energy = cosserat::energy_of(model, step.after, gravity_);
  springs_ = springs;
  found_ = energy.kinetic + energy.elastic + springs;
  put_in_ = work_ - energy.gravity;
  largest_ = std::max(largest_, put_in_);
}

}  // namespace pedicel::stress
