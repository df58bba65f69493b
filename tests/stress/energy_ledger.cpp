#include "stress/energy_ledger.h"

#include <algorithm>

#include "cosserat/rotation.h"
#include "cosserat/self_contact.h"

namespace pedicel::stress {

using cosserat::ContactForce;
using cosserat::Element;
using cosserat::RodModel;
using cosserat::RodState;
using cosserat::Strain;

namespace {

// J: below this, rounding is all there is.
constexpr double rounding = 1.0e-12;

double work_of(const Vec3& force, const Vec3& displacement, bool is_converged) {
  return is_converged ? force.dot(displacement) : force.norm() * displacement.norm();
}

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
  const Vec3 force = contact.normal * contact.point.normal_W + contact.tangential_W;
  return work_of(force, contact.point.surface_motion_W, is_converged);
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

EnergyLedger::EnergyLedger(const RodModel& model, const RodState& start, const Vec3& gravity)
    : gravity_(gravity) {
  for (int e = 0; e < model.size(); ++e) {
    if (model.elements[e].parent >= 0) continue;
    roots_.push_back(e);
    root_strain_.push_back(cosserat::strain_of(model, start, e));
  }
  const cosserat::Energy energy = cosserat::energy_of(model, start, gravity);
  work_ = energy.total();
  found_ = put_in_ = largest_ = energy.kinetic + energy.elastic;
}

double EnergyLedger::slack() const {
  return std::max(largest_, 0.0) + rounding;
}

// The clamp feels force and moment of the segments that start there, with their damping.
double EnergyLedger::root_work(const RodModel& model, const BookedStep& step) {
  const Vec3 shift = step.after.root.position - step.before.root.position;
  const Vec3 turn = turn_between(step.before.root.rotation, step.after.root.rotation);
  double work = 0.0;
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    const int e = roots_[i];
    const Element& element = model.elements[e];
    const Strain before = root_strain_[i], now = cosserat::strain_of(model, step.after, e);
    root_strain_[i] = now;
    if (!step.before.alive[e]) continue;
    const double viscous = element.damping_time / step.dt;
    const Vec3 stretch = now.stretch + viscous * (now.stretch - before.stretch);
    const Vec3 bend = now.bend + viscous * (now.bend - before.bend);
    const Vec3 force = element.stretch_stiffness.cwiseProduct(stretch);
    const Vec3 moment = cosserat::inverse_right_jacobian(now.bend).transpose() *
                        element.bend_stiffness.cwiseProduct(bend);
    const Quat& q = step.after.orientation[e];
    work += work_of(q * force, -shift, step.is_converged) +
            work_of(q * moment, -turn, step.is_converged);
  }
  return work;
}

// The colliders go first, the plant holds still: their springs are pressed.
double EnergyLedger::meeting_work(const BookedStep& step) const {
  double pressed = 0.0;
  for (const cosserat::ContactPoint& point : step.meeting)
    pressed += 0.5 * point.stiffness * std::pow(std::max(0.0, point.margin - point.gap), 2);
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
  work_ += root_work(model, step);
  if (!step.is_converged) work_ += meeting_work(step);
  const cosserat::Energy energy = cosserat::energy_of(model, step.after, gravity_);
  springs_ = springs;
  found_ = energy.kinetic + energy.elastic + springs;
  put_in_ = work_ - energy.gravity;
  largest_ = std::max(largest_, put_in_);
}

}  // namespace pedicel::stress
