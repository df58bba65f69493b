#include "plugins/cosserat/solver/position_based_projections.h"

#include <algorithm>
#include <cmath>

#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/position_based_constraints.h"

namespace pedicel::cosserat {

namespace {

const Quat& parent_rotation(const RodModel& model, const RodState& state, int element) {
  const int parent = model.elements[element].parent;
  return parent < 0 ? state.root.rotation : state.orientation[parent];
}

// 1/k, where a part without stiffness never pushes back.
// A large number and not infinity: infinity times a multiplier of zero would be no number.
Vec3 compliance_of(const Vec3& stiffness) {
  constexpr double none = 1.0e30;
  return (stiffness.array() > 0.0).select(stiffness.cwiseInverse(), none);
}

}  // namespace

PositionBasedProjections::PositionBasedProjections(const RodModel& model)
    : bodies_(model.elements.size()),
      stretch_(model.elements.size()),
      bend_(model.elements.size()),
      support_position_(model.supports.size()),
      support_rotation_(model.supports.size()),
      weld_position_(model.welds.size()),
      weld_rotation_(model.welds.size()) {}

void PositionBasedProjections::begin(double h) {
  h_ = h;
  for (auto* list : {&stretch_, &bend_, &support_position_, &support_rotation_, &weld_position_,
                     &weld_rotation_})
    // XPBD's multipliers are totals of a sub-step. Kept over to the next one, they would push with
    // the impulse of a time that is over.
    std::fill(list->begin(), list->end(), Vec3::Zero());
}

void PositionBasedProjections::sweep(const RodModel& model, RodState& state,
                                     std::vector<Contact>& contacts, double surface_share) {
  // Of this sweep alone: what counts at the end is how much the last one still changed.
  change_.size = 0.0;
  // Gauss-Seidel: each projection sees what the one before has done. From the root outward, what
  // moves there reaches the tip within one sweep. A load at the tip goes back by one element a
  // sweep, so more nodes want more sweeps.
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    project_stretch(model, state, e);
    project_bend(model, state, e);
  }
  for (int i = 0; i < static_cast<int>(model.welds.size()); ++i) project_weld(model, state, i);
  for (int i = 0; i < static_cast<int>(model.supports.size()); ++i)
    project_support(model, state, i);
  // Contacts come last: what is projected last holds best, and nothing should end inside a robot.
  for (Contact& contact : contacts) project_contact(model, state, contact, surface_share);
}

void PositionBasedProjections::damp(const RodModel& model, const RodState& state, int element) {
  damp_stretch(model, state, element);
  damp_bend(model, state, element);
}

// Adds the multiplier that answers `value` to `lambda` (XPBD, eq. 18); `response` is the sum of
// gradient x inverse mass x gradient^T.
Vec3 PositionBasedProjections::multiplier_step(const Mat3& response, const Vec3& compliance,
                                               const Vec3& value, Vec3& lambda) const {
  // Compliance over h squared, as in XPBD: so a constraint's stiffness does not depend on the
  // length of the sub-step, as far as sweeps converge.
  const Vec3 scaled = compliance / (h_ * h_);
  Mat3 matrix = response;
  matrix.diagonal() += scaled;
  // All three directions of a constraint at once. One after the other they would not see each
  // other's turn of the segment, and shear would pull at the bend in each sweep.
  const Vec3 step = -matrix.ldlt().solve(value + scaled.cwiseProduct(lambda));
  // Nothing moves, as where all masses of the constraint are infinite. The multiplier stays clean,
  // so that a later sweep can go on.
  if (!step.allFinite()) return Vec3::Zero();
  lambda += step;
  return step;
}

void PositionBasedProjections::move_node(RodState& state, int element, const Vec3& change,
                                         double limit) {
  // One length of a segment at most: with a long sub-step a correction may overshoot the range in
  // which the constraint is nearly linear.
  const Vec3 move = clamped(change, limit);
  state.position[element] += move;
  if (move.norm() > change_.size) change_ = {move.norm(), element};
}

void PositionBasedProjections::turn(RodState& state, int element, const Vec3& delta) {
  const Vec3 move = clamped(delta, largest_turn);
  // From the right, as the constraints are derived by a turn in the element's own frame.
  state.orientation[element] = (state.orientation[element] * exp_map(move)).normalized();
  if (move.norm() > change_.size) change_ = {move.norm(), element};
}

Mat3 PositionBasedProjections::stretch_response(const RodModel& model, int e,
                                                const Mat3& by_turn) const {
  // In E, since the constraint is: the node's part is R^T m^-1 R, which is m^-1 for both nodes.
  Mat3 response = by_turn * bodies_[e].inverse_inertia.asDiagonal() * by_turn.transpose();
  response.diagonal().array() += bodies_[e].inverse_mass + inverse_mass(model.elements[e].parent);
  return response;
}

Mat3 PositionBasedProjections::bend_response(const RodModel& model, int e,
                                             const Mat3& to_parent) const {
  const int parent = model.elements[e].parent;
  // Each inertia in its own element's axes. The parent's is turned into this element's, in which
  // the strain is.
  Mat3 response = bodies_[e].inverse_inertia.asDiagonal();
  if (parent >= 0)
    response += to_parent.transpose() * bodies_[parent].inverse_inertia.asDiagonal() * to_parent;
  return response;
}

void PositionBasedProjections::project_stretch(const RodModel& model, RodState& state, int e) {
  const Element& element = model.elements[e];
  const Vec3 near = start_of(model, state, e);
  const Quat q = state.orientation[e];
  const Mat3 by_turn = stretch_shear_by_rotation(near, state.position[e], q);
  const Vec3 value = stretch_shear(near, state.position[e], q, element.length, element.rest_strain);
  // The constraint is l C_s in metres, and the energy 1/2 k l C_s^2 of a strain: in metres the
  // stiffness is k / l.
  const Vec3 compliance = element.length * compliance_of(element.stretch_stiffness);
  const Vec3 step =
      multiplier_step(stretch_response(model, e, by_turn), compliance, value, stretch_[e]);
  // By `q` as it was: the constraint was linearised there, and the element is turned last.
  move_node(state, e, bodies_[e].inverse_mass * (q * step), element.length);
  if (element.parent >= 0)
    move_node(state, element.parent, -inverse_mass(element.parent) * (q * step), element.length);
  turn(state, e, bodies_[e].inverse_inertia.cwiseProduct(by_turn.transpose() * step));
}

void PositionBasedProjections::project_bend(const RodModel& model, RodState& state, int e) {
  const Element& element = model.elements[e];
  const Quat before = parent_rotation(model, state, e);
  const Mat3 to_parent = (before.conjugate() * state.orientation[e]).toRotationMatrix();
  const Vec3 value = bend_twist(before, state.orientation[e], element.rest_rotation);
  // By the full rest rotation: with the vector part of Omega - s Omega0 alone a joint drawn at an
  // angle would be softer than a straight one.
  const Vec3 step = multiplier_step(bend_response(model, e, to_parent),
                                    compliance_of(element.bend_stiffness), value, bend_[e]);
  turn(state, e, bodies_[e].inverse_inertia.cwiseProduct(step));
  if (element.parent < 0) return;
  // The opposite turn for the parent, in the parent's own axes. Together the two do not turn the
  // pair.
  turn(state, element.parent,
       -bodies_[element.parent].inverse_inertia.cwiseProduct(to_parent * step));
}

double PositionBasedProjections::inverse_mass_at(const RodModel& model, int element,
                                                 double back) const {
  // A place between two nodes moves with both, and so by the lever rule on either side: once for
  // how the impulse is shared, once for how far the place follows.
  const double near = back / model.elements[element].length;
  return (1.0 - near) * (1.0 - near) * bodies_[element].inverse_mass +
         near * near * inverse_mass(model.elements[element].parent);
}

void PositionBasedProjections::move_place(const RodModel& model, RodState& state, int element,
                                          double back, const Vec3& impulse) {
  const Element& segment = model.elements[element];
  const double near = back / segment.length;
  move_node(state, element, (1.0 - near) * bodies_[element].inverse_mass * impulse, segment.length);
  if (segment.parent >= 0)
    move_node(state, segment.parent, near * inverse_mass(segment.parent) * impulse, segment.length);
}

void PositionBasedProjections::project_support(const RodModel& model, RodState& state, int i) {
  const Support& support = model.supports[i];
  const int e = support.element;
  if (!state.alive[e]) return;
  // Force and moment of a support are two constraints, one after the other. A place off the node is
  // not turned by its force here; the sweeps share that out through the stretch.
  const Mat3 response = inverse_mass_at(model, e, support.back) * Mat3::Identity();
  const Vec3 gap = point_on(model, state, e, support.back) - support.position;
  const Vec3 stiffness = Vec3::Constant(support.position_stiffness);
  move_place(model, state, e, support.back,
             multiplier_step(response, compliance_of(stiffness), gap, support_position_[i]));
  // The strain is in the element's axes, as a joint's is in the child's.
  const Mat3 turning = bodies_[e].inverse_inertia.asDiagonal();
  const Vec3 angle = bend_twist(Quat::Identity(), state.orientation[e], support.rotation);
  const Vec3 step = multiplier_step(turning, compliance_of(support.rotation_stiffness), angle,
                                    support_rotation_[i]);
  turn(state, e, turning * step);
}

void PositionBasedProjections::project_weld(const RodModel& model, RodState& state, int i) {
  const Weld& weld = model.welds[i];
  if (!state.alive[weld.a] || !state.alive[weld.b]) return;
  const Body &a = bodies_[weld.a], &b = bodies_[weld.b];
  // A weld joins child nodes, so no lever comes in, and the gap is a vector in W.
  const Mat3 response = (a.inverse_mass + b.inverse_mass) * Mat3::Identity();
  const Vec3 stiffness = Vec3::Constant(weld.position_stiffness);
  const Vec3 push =
      multiplier_step(response, compliance_of(stiffness),
                      state.position[weld.b] - state.position[weld.a], weld_position_[i]);
  move_node(state, weld.a, -a.inverse_mass * push, model.elements[weld.a].length);
  move_node(state, weld.b, b.inverse_mass * push, model.elements[weld.b].length);

  const Quat &qa = state.orientation[weld.a], &qb = state.orientation[weld.b];
  // Weld a stands for the parent, and b for the child, in whose axes the strain is.
  const Mat3 to_a = (qa.conjugate() * qb).toRotationMatrix();
  Mat3 turning = to_a.transpose() * a.inverse_inertia.asDiagonal() * to_a;
  turning.diagonal() += b.inverse_inertia;
  const Vec3 step = multiplier_step(turning, compliance_of(weld.bend_stiffness),
                                    bend_twist(qa, qb, weld.rest_rotation), weld_rotation_[i]);
  turn(state, weld.b, b.inverse_inertia.cwiseProduct(step));
  turn(state, weld.a, -a.inverse_inertia.cwiseProduct(to_a * step));
}

void PositionBasedProjections::project_contact(const RodModel& model, RodState& state,
                                               Contact& contact, double surface_share) {
  const ContactPoint& point = contact.point;
  const int e = model.shapes[point.shape].element;
  const double response = inverse_mass_at(model, e, point.back);
  // What came off, or is held by the clamp at both of its nodes, cannot be pushed.
  if (!(response > 0.0)) return;
  const Vec3& n = point.normal_W;
  Vec3 place = point_on(model, state, e, point.back);
  // Without a stiffness the contact is rigid, which a projection can be and a spring cannot.
  const double compliance = point.stiffness > 0.0 ? 1.0 / (point.stiffness * h_ * h_) : 0.0;
  const double gap = point.gap - point.margin + n.dot(place - contact.found_at);
  const double step = -(gap + compliance * contact.normal) / (response + compliance);
  // The total is held to push, not the step: a later sweep may give back what an earlier one pushed
  // too much.
  const double normal = std::max(0.0, contact.normal + step);
  move_place(model, state, e, point.back, (normal - contact.normal) * n);
  contact.normal = normal;

  // Coulomb: pull the place back to where the surface has carried it, as far as friction reaches.
  // Anew, because the normal's push has just moved it.
  place = point_on(model, state, e, point.back);
  const Vec3 slide = place - contact.place - surface_share * point.surface_motion_W;
  const Vec3 wanted = contact.tangential - (slide - n.dot(slide) * n) / response;
  // Coulomb's cone in multipliers: both are mass times way of the same sub-step, so mu times the
  // one bounds the other.
  const double reach = point.friction * contact.normal;
  const Vec3 tangential = clamped(wanted, reach);
  contact.slipping = wanted.norm() > reach;
  move_place(model, state, e, point.back, tangential - contact.tangential);
  contact.tangential = tangential;
}

// The impulse against a strain rate, implicit: after it the damper's force goes with the rate that
// is left, so no damping is too strong.
Vec3 PositionBasedProjections::damping_impulse(const Mat3& response, const Vec3& damping,
                                               const Vec3& rate) const {
  Mat3 matrix = response;
  // In the limit of strong damping the rate goes to zero, and no further. An explicit damper would
  // reverse it as soon as h times damping exceeds what the masses can bear.
  matrix.diagonal() += compliance_of(h_ * damping);
  const Vec3 impulse = -matrix.ldlt().solve(rate);
  return impulse.allFinite() ? impulse : Vec3::Zero();
}

void PositionBasedProjections::damp_stretch(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  Body& body = bodies_[e];
  Body* parent = element.parent < 0 ? nullptr : &bodies_[element.parent];
  const Quat& q = state.orientation[e];
  const Mat3 by_turn = stretch_shear_by_rotation(start_of(model, state, e), state.position[e], q);
  // Without a parent there is the clamp, which is taken to stand still.
  const Vec3 apart = parent ? Vec3(body.velocity - parent->velocity) : body.velocity;
  // Kelvin-Voigt: the damper is the spring times the damping time, in the same metres as the
  // constraint.
  const Vec3 damping = element.damping_time / element.length * element.stretch_stiffness;
  const Vec3 impulse = damping_impulse(stretch_response(model, e, by_turn), damping,
                                       q.conjugate() * apart + by_turn * body.spin);
  body.velocity += body.inverse_mass * (q * impulse);
  body.spin += body.inverse_inertia.cwiseProduct(by_turn.transpose() * impulse);
  if (parent) parent->velocity -= parent->inverse_mass * (q * impulse);
}

void PositionBasedProjections::damp_bend(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  Body& body = bodies_[e];
  Body* parent = element.parent < 0 ? nullptr : &bodies_[element.parent];
  const Quat& before = parent_rotation(model, state, e);
  const Mat3 to_parent = (before.conjugate() * state.orientation[e]).toRotationMatrix();
  // Both spins are in their own axes; the parent's is turned into the child's before they are
  // compared.
  const Vec3 rate = parent ? Vec3(body.spin - to_parent.transpose() * parent->spin) : body.spin;
  const Vec3 impulse = damping_impulse(bend_response(model, e, to_parent),
                                       element.damping_time * element.bend_stiffness, rate);
  body.spin += body.inverse_inertia.cwiseProduct(impulse);
  if (parent) parent->spin -= parent->inverse_inertia.cwiseProduct(to_parent * impulse);
}

}  // namespace pedicel::cosserat
