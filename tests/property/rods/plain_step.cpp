#include "tests/property/rods/plain_step.h"

#include <cmath>

#include "tests/property/rods/plain_rotation.h"

namespace pedicel::plain {

using cosserat::Element;
using cosserat::RodModel;
using cosserat::RodState;

namespace {

constexpr double pi = 3.14159265358979323846;

const Vec3 along_axis = Vec3::UnitZ();

Pose pose_of(const RodState& state, int e) {
  return {state.position[e], state.orientation[e]};
}

Pose parent_of(const RodModel& model, const RodState& state, int e) {
  const int parent = model.elements[e].parent;
  return parent < 0 ? state.previous_root : pose_of(state, parent);
}

Vec3 centre_of(const Element& element, const Pose& own) {
  return own.position - element.com_back * (own.rotation * along_axis);
}

Vec3 stretch_of(const Element& element, const Pose& parent, const Pose& own) {
  const Vec3 along = (own.position - parent.position) / element.length;
  return own.rotation.conjugate() * along - along_axis - element.rest_strain;
}

Vec3 bend_of(const Element& element, const Pose& parent, const Pose& own) {
  return rotation_vector(element.rest_rotation.conjugate() * parent.rotation.conjugate() *
                         own.rotation);
}

}  // namespace

Place place_of(const RodState& state) {
  return {state.position, state.orientation};
}

Place moved(const Place& place, const std::vector<Six>& change, double share) {
  Place out = place;
  for (std::size_t e = 0; e < change.size(); ++e) {
    out.position[e] += share * change[e].head<3>();
    out.orientation[e] = (turn_by(share * change[e].tail<3>()) * place.orientation[e]).normalized();
  }
  return out;
}

Step::Step(const RodModel& model, const RodState& now, const RodState* before, double dt,
           const Vec3& gravity, std::span<const cosserat::Load> loads)
    : model_(model),
      now_(now),
      before_(before),
      dt_(dt),
      h_(before ? 2.0 / 3.0 * dt : dt),
      a_(before ? 4.0 / 3.0 : 1.0),
      b_(before ? 1.0 / 3.0 : 0.0),
      gravity_(gravity),
      loads_(loads) {
  for (int e = 0; e < model.size(); ++e) terms_.push_back(terms_of(e));
}

Step::Terms Step::terms_of(int e) const {
  const Element& element = model_.elements[e];
  const RodState& before = before_ ? *before_ : now_;
  const Pose own = pose_of(now_, e), own_before = pose_of(before, e);
  Terms terms;
  terms.past.position = a_ * centre_of(element, own) - b_ * centre_of(element, own_before);
  terms.past.rotation =
      own.rotation * turn_by(b_ * rotation_vector(own_before.rotation.conjugate() * own.rotation));

  // Euler's equations in E; the gyroscopic torque is that of the rate extrapolated to the end.
  const Vec3 rate = now_.angular_velocity[e], rate_before = before.angular_velocity[e];
  const Vec3 later = 2.0 * rate - rate_before, inertia = element.inertia;
  const Vec3 gyroscopic = later.cross(inertia.cwiseProduct(later)).cwiseQuotient(inertia);
  const double drag = 1.0 + element.mass_damping * h_;
  terms.com_target =
      terms.past.position + h_ / drag * (a_ * now_.velocity[e] - b_ * before.velocity[e]);
  terms.rotation_target =
      terms.past.rotation * turn_by(h_ / drag * (a_ * rate - b_ * rate_before - h_ * gyroscopic));
  terms.inertia_scale = drag / (h_ * h_);

  const double modulus =
      model_.laws.empty() && model_.air.empty() && model_.stiffness_drift == 0.0
          ? 1.0
          : std::max(0.01, 1.0 + model_.stiffness_drift * (model_.clock + now_.time + dt_));
  const double viscous = element.damping_time / h_, share = viscous / (1.0 + viscous);
  const Pose parent = plain::parent_of(model_, now_, e);
  const Pose parent_before = plain::parent_of(model_, before, e);
  terms.stretch_rate = modulus * (1.0 + viscous) * element.stretch_stiffness;
  terms.stretch_target = share * (a_ * stretch_of(element, parent, own) -
                                  b_ * stretch_of(element, parent_before, own_before));
  JointStep& joint = terms.joint;
  joint.now = bend_of(element, parent, own);
  joint.stiffness = modulus * element.bend_stiffness;
  joint.stiffening = 1.0 + viscous;
  joint.target = share * (a_ * joint.now - b_ * bend_of(element, parent_before, own_before));
  joint.dt = dt_;
  if (!model_.laws.empty()) {
    const std::size_t branches = now_.joint_memory.size() / model_.laws.size();
    joint.law = &model_.laws[e];
    joint.memory = {now_.joint_memory.data() + e * branches, branches};
    joint.bias = now_.joint_bias[e];
  }
  if (!model_.air.empty()) {
    const cosserat::SegmentAir& air = model_.air[e];
    terms.middle_past = a_ * middle_of(e, own) - b_ * middle_of(e, own_before);
    terms.air =
        air.velocity + std::sin(2.0 * pi * model_.gust_frequency * (now_.time + dt_)) * air.gust;
    terms.drag = 0.5 * 1.2 * air.drag_area * element.length;
  }
  return terms;
}

Pose Step::parent_of(int e, const Place& place) const {
  const int parent = model_.elements[e].parent;
  if (parent < 0) return now_.root;
  return {place.position[parent], place.orientation[parent]};
}

Vec3 Step::middle_of(int e, const Pose& own) const {
  return own.position - 0.5 * model_.elements[e].length * (own.rotation * along_axis);
}

Step::Air Step::air_of(int e, const Pose& own, const Vec3& axis) const {
  const Vec3 relative = terms_[e].air - (middle_of(e, own) - terms_[e].middle_past) / h_;
  const Vec3 u = relative - axis * axis.dot(relative);
  return {u, u.norm()};
}

Step::Strained Step::strained(int e, const Place& place) const {
  const Element& element = model_.elements[e];
  const Pose parent = parent_of(e, place), own{place.position[e], place.orientation[e]};
  Strained s;
  s.r = own.rotation.toRotationMatrix();
  s.along = (own.position - parent.position) / element.length;
  s.stretch = stretch_of(element, parent, own) - terms_[e].stretch_target;
  s.phi = bend_of(element, parent, own);
  s.off = centre_of(element, own) - terms_[e].com_target;
  s.from_target = terms_[e].rotation_target.conjugate() * own.rotation;
  if (s.from_target.w() < 0.0) s.from_target.coeffs() *= -1.0;
  s.turn = 2.0 * s.from_target.vec();
  return s;
}

double Step::potential_of(int e, const Place& place, const Place& about) const {
  const Element& element = model_.elements[e];
  const Terms& terms = terms_[e];
  const Strained s = strained(e, place);
  double energy =
      0.5 * element.length * s.stretch.dot(terms.stretch_rate.cwiseProduct(s.stretch)) +
      answer(terms.joint, s.phi).energy +
      0.5 * terms.inertia_scale *
          (element.mass * s.off.squaredNorm() + s.turn.dot(element.inertia.cwiseProduct(s.turn))) -
      element.mass * gravity_.dot(s.off);
  if (terms.drag > 0.0) {
    const Vec3 axis = about.orientation[e] * along_axis;
    const double speed = air_of(e, {place.position[e], place.orientation[e]}, axis).speed;
    energy += h_ * terms.drag / 3.0 * speed * speed * speed;
  }
  return energy;
}

Place Step::first_guess() const {
  Place guess = place_of(now_);
  for (int e = 0; e < model_.size(); ++e) {
    if (!now_.alive[e]) continue;
    const Vec3& rate = now_.angular_velocity[e];
    guess.orientation[e] = now_.orientation[e] * turn_by(dt_ * rate);
    guess.position[e] = centre_of(model_.elements[e], pose_of(now_, e)) + dt_ * now_.velocity[e] +
                        model_.elements[e].com_back * (guess.orientation[e] * along_axis);
  }
  return guess;
}

RodState Step::end(const Place& place) const {
  RodState after = now_;
  for (int e = 0; e < model_.size(); ++e) {
    if (!now_.alive[e]) continue;
    const Terms& terms = terms_[e];
    const Pose own{place.position[e], place.orientation[e]};
    after.position[e] = own.position;
    after.orientation[e] = own.rotation;
    after.velocity[e] = (centre_of(model_.elements[e], own) - terms.past.position) / h_;
    after.angular_velocity[e] =
        rotation_vector(terms.past.rotation.conjugate() * own.rotation) / h_;
    const std::vector<Vec3> memory = memory_after(terms.joint, strained(e, place).phi);
    std::copy(memory.begin(), memory.end(),
              after.joint_memory.begin() + static_cast<std::ptrdiff_t>(e * memory.size()));
  }
  after.previous_root = after.root;
  after.time += dt_;
  return after;
}

}  // namespace pedicel::plain
