#include "cosserat/position_based_solver.h"

#include <algorithm>
#include <cmath>

#include "cosserat/position_based_constraints.h"
#include "cosserat/rotation.h"

namespace pedicel::cosserat {

namespace {

constexpr double largest_turn = 0.5;  // rad, of one correction

const Quat& parent_rotation(const RodModel& model, const RodState& state, int element) {
  const int parent = model.elements[element].parent;
  return parent < 0 ? state.root.rotation : state.orientation[parent];
}

Vec3 clamped(const Vec3& v, double limit) {
  const double norm = v.norm();
  if (!std::isfinite(norm)) return Vec3::Zero();
  return norm > limit ? Vec3(limit / norm * v) : v;
}

// 1/k, where a part without stiffness never pushes back.
Vec3 compliance_of(const Vec3& stiffness) {
  constexpr double none = 1.0e30;
  return (stiffness.array() > 0.0).select(stiffness.cwiseInverse(), none);
}

}  // namespace

PositionBasedSolver::PositionBasedSolver(const RodSettings& settings, const RodModel& model)
    : settings_(settings), bodies_(model.elements.size()) {
  stretch_.resize(model.elements.size());
  bend_.resize(model.elements.size());
  support_position_.resize(model.supports.size());
  support_rotation_.resize(model.supports.size());
  weld_position_.resize(model.welds.size());
  weld_rotation_.resize(model.welds.size());
  const std::size_t contacts = 2 * model.shapes.size();
  found_.reserve(contacts);
  contacts_.reserve(contacts);
  forces_.reserve(contacts);
}

StepReport PositionBasedSolver::step(const RodModel& model, RodState& state,
                                     const StepInput& input) {
  StepReport report;
  remember(state);
  for (ContactSource* source : input.contacts) source->begin_step(model, state, input.dt);
  share_masses(model, state);
  const int substeps = std::max(1, settings_.substeps);
  h_ = input.dt / substeps;
  for (int s = 0; s < substeps; ++s) {
    gather_loads(model, state, input);
    predict(model, state);
    clear_multipliers();
    find_contacts(model, state, input);
    for (int i = 0; i < settings_.iterations; ++i) sweep(model, state, 1.0 / substeps);
    update_velocities(model, state);
  }
  report.iterations = substeps * settings_.iterations;
  report.last_change = largest_change_;
  report.element = largest_element_;
  const auto finite = [](const Vec3& p) { return p.allFinite(); };
  if (!std::all_of(state.position.begin(), state.position.end(), finite) ||
      !std::all_of(state.velocity.begin(), state.velocity.end(), finite)) {
    report.errors |= not_finite;
    forces_.clear();
    restore(state);
    return report;
  }
  report_contacts(model, state, report);
  state.time += input.dt;
  return report;
}

void PositionBasedSolver::remember(const RodState& state) {
  old_position_ = state.position;
  old_orientation_ = state.orientation;
  old_velocity_ = state.velocity;
  old_angular_velocity_ = state.angular_velocity;
}

void PositionBasedSolver::restore(RodState& state) const {
  state.position = old_position_;
  state.orientation = old_orientation_;
  state.velocity = old_velocity_;
  state.angular_velocity = old_angular_velocity_;
}

void PositionBasedSolver::share_masses(const RodModel& model, const RodState& state) {
  for (Body& body : bodies_) body.node_mass = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    if (!state.alive[e]) continue;
    const double near = std::clamp(element.com_back / element.length, 0.0, 1.0);
    bodies_[e].node_mass += (1.0 - near) * element.mass;
    if (element.parent >= 0) bodies_[element.parent].node_mass += near * element.mass;
    bodies_[e].velocity = velocity_on(model, state, e, 0.0);
  }
  for (int e = 0; e < model.size(); ++e) {
    Body& body = bodies_[e];
    body.inverse_mass = body.node_mass > 0.0 ? 1.0 / body.node_mass : 0.0;
    body.inverse_inertia =
        state.alive[e] ? Vec3(model.elements[e].inertia.cwiseInverse()) : Vec3::Zero();
  }
}

void PositionBasedSolver::gather_loads(const RodModel& model, const RodState& state,
                                       const StepInput& input) {
  for (Body& body : bodies_) {
    body.force = body.node_mass * input.gravity;
    body.moment.setZero();
  }
  for (const Load& load : input.loads) {
    if (!state.alive[load.element]) continue;
    const Element& element = model.elements[load.element];
    const double near = load.back / element.length;
    bodies_[load.element].force += (1.0 - near) * load.force_W;
    bodies_[load.element].moment += load.moment_W;
    if (element.parent >= 0) bodies_[element.parent].force += near * load.force_W;
  }
}

void PositionBasedSolver::predict(const RodModel& model, RodState& state) {
  for (int e = 0; e < model.size(); ++e) {
    Body& body = bodies_[e];
    body.position = state.position[e];
    body.orientation = state.orientation[e];
    if (!state.alive[e]) continue;
    const Element& element = model.elements[e];
    const double kept = 1.0 / (1.0 + h_ * element.mass_damping);
    body.velocity = kept * (body.velocity + h_ * body.inverse_mass * body.force);
    state.position[e] += h_ * body.velocity;

    const Vec3& omega = state.angular_velocity[e];
    const Vec3 gyroscopic = omega.cross(element.inertia.cwiseProduct(omega));
    const Vec3 moment = state.orientation[e].conjugate() * body.moment - gyroscopic;
    const Vec3 next = kept * (omega + h_ * body.inverse_inertia.cwiseProduct(moment));
    state.orientation[e] =
        (state.orientation[e] * exp_map(clamped(h_ * next, largest_turn))).normalized();
  }
}

void PositionBasedSolver::clear_multipliers() {
  for (auto* list : {&stretch_, &bend_, &support_position_, &support_rotation_, &weld_position_,
                     &weld_rotation_})
    std::fill(list->begin(), list->end(), Vec3::Zero());
}

void PositionBasedSolver::find_contacts(const RodModel& model, const RodState& state,
                                        const StepInput& input) {
  contacts_.clear();
  for (ContactSource* source : input.contacts) {
    found_.clear();
    source->find(model, state, input.dt, found_);
    for (const ContactPoint& point : found_) {
      const int e = model.shapes[point.shape].element, parent = model.elements[e].parent;
      if (!state.alive[e]) continue;
      const double t = point.back / model.elements[e].length;
      const Vec3& near = parent < 0 ? state.root.position : bodies_[parent].position;
      Contact contact;
      contact.point = point;
      contact.place = (1.0 - t) * bodies_[e].position + t * near;
      contact.found_at = point_on(model, state, e, point.back);
      contacts_.push_back(contact);
    }
  }
}

void PositionBasedSolver::sweep(const RodModel& model, RodState& state, double surface_share) {
  largest_change_ = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    project_stretch(model, state, e);
    project_bend(model, state, e);
  }
  for (int i = 0; i < static_cast<int>(model.welds.size()); ++i) project_weld(model, state, i);
  for (int i = 0; i < static_cast<int>(model.supports.size()); ++i)
    project_support(model, state, i);
  for (Contact& contact : contacts_) project_contact(model, state, contact, surface_share);
}

// Adds the multiplier that answers `value` to `lambda` (XPBD, eq. 18); `response` is the sum of
// gradient x inverse mass x gradient^T.
Vec3 PositionBasedSolver::multiplier_step(const Mat3& response, const Vec3& compliance,
                                          const Vec3& value, Vec3& lambda) const {
  const Vec3 scaled = compliance / (h_ * h_);
  Mat3 matrix = response;
  matrix.diagonal() += scaled;
  const Vec3 step = -matrix.ldlt().solve(value + scaled.cwiseProduct(lambda));
  if (!step.allFinite()) return Vec3::Zero();
  lambda += step;
  return step;
}

void PositionBasedSolver::move_node(RodState& state, int element, const Vec3& change,
                                    double limit) {
  const Vec3 move = clamped(change, limit);
  state.position[element] += move;
  if (move.norm() > largest_change_) {
    largest_change_ = move.norm();
    largest_element_ = element;
  }
}

void PositionBasedSolver::turn(RodState& state, int element, const Vec3& delta) {
  const Vec3 move = clamped(delta, largest_turn);
  state.orientation[element] = (state.orientation[element] * exp_map(move)).normalized();
  if (move.norm() > largest_change_) {
    largest_change_ = move.norm();
    largest_element_ = element;
  }
}

Mat3 PositionBasedSolver::stretch_response(const RodModel& model, int e,
                                           const Mat3& by_turn) const {
  Mat3 response = by_turn * bodies_[e].inverse_inertia.asDiagonal() * by_turn.transpose();
  response.diagonal().array() += bodies_[e].inverse_mass + inverse_mass(model.elements[e].parent);
  return response;
}

Mat3 PositionBasedSolver::bend_response(const RodModel& model, int e, const Mat3& to_parent) const {
  const int parent = model.elements[e].parent;
  Mat3 response = bodies_[e].inverse_inertia.asDiagonal();
  if (parent >= 0)
    response += to_parent.transpose() * bodies_[parent].inverse_inertia.asDiagonal() * to_parent;
  return response;
}

void PositionBasedSolver::project_stretch(const RodModel& model, RodState& state, int e) {
  const Element& element = model.elements[e];
  const Vec3 near = start_of(model, state, e);
  const Quat q = state.orientation[e];
  const Mat3 by_turn = stretch_shear_by_rotation(near, state.position[e], q);
  const Vec3 value = stretch_shear(near, state.position[e], q, element.length, element.rest_strain);
  const Vec3 compliance = element.length * compliance_of(element.stretch_stiffness);
  const Vec3 step =
      multiplier_step(stretch_response(model, e, by_turn), compliance, value, stretch_[e]);
  move_node(state, e, bodies_[e].inverse_mass * (q * step), element.length);
  if (element.parent >= 0)
    move_node(state, element.parent, -inverse_mass(element.parent) * (q * step), element.length);
  turn(state, e, bodies_[e].inverse_inertia.cwiseProduct(by_turn.transpose() * step));
}

void PositionBasedSolver::project_bend(const RodModel& model, RodState& state, int e) {
  const Element& element = model.elements[e];
  const Quat before = parent_rotation(model, state, e);
  const Mat3 to_parent = (before.conjugate() * state.orientation[e]).toRotationMatrix();
  const Vec3 value = bend_twist(before, state.orientation[e], element.rest_rotation);
  const Vec3 step = multiplier_step(bend_response(model, e, to_parent),
                                    compliance_of(element.bend_stiffness), value, bend_[e]);
  turn(state, e, bodies_[e].inverse_inertia.cwiseProduct(step));
  if (element.parent < 0) return;
  turn(state, element.parent,
       -bodies_[element.parent].inverse_inertia.cwiseProduct(to_parent * step));
}

double PositionBasedSolver::inverse_mass_at(const RodModel& model, int element, double back) const {
  const double near = back / model.elements[element].length;
  return (1.0 - near) * (1.0 - near) * bodies_[element].inverse_mass +
         near * near * inverse_mass(model.elements[element].parent);
}

void PositionBasedSolver::move_place(const RodModel& model, RodState& state, int element,
                                     double back, const Vec3& impulse) {
  const Element& segment = model.elements[element];
  const double near = back / segment.length;
  move_node(state, element, (1.0 - near) * bodies_[element].inverse_mass * impulse, segment.length);
  if (segment.parent >= 0)
    move_node(state, segment.parent, near * inverse_mass(segment.parent) * impulse, segment.length);
}

void PositionBasedSolver::project_support(const RodModel& model, RodState& state, int i) {
  const Support& support = model.supports[i];
  const int e = support.element;
  if (!state.alive[e]) return;
  const Mat3 response = inverse_mass_at(model, e, support.back) * Mat3::Identity();
  const Vec3 gap = point_on(model, state, e, support.back) - support.position;
  const Vec3 stiffness = Vec3::Constant(support.position_stiffness);
  move_place(model, state, e, support.back,
             multiplier_step(response, compliance_of(stiffness), gap, support_position_[i]));
  const Mat3 turning = bodies_[e].inverse_inertia.asDiagonal();
  const Vec3 angle = bend_twist(Quat::Identity(), state.orientation[e], support.rotation);
  const Vec3 step = multiplier_step(turning, compliance_of(support.rotation_stiffness), angle,
                                    support_rotation_[i]);
  turn(state, e, turning * step);
}

void PositionBasedSolver::project_weld(const RodModel& model, RodState& state, int i) {
  const Weld& weld = model.welds[i];
  if (!state.alive[weld.a] || !state.alive[weld.b]) return;
  const Body &a = bodies_[weld.a], &b = bodies_[weld.b];
  const Mat3 response = (a.inverse_mass + b.inverse_mass) * Mat3::Identity();
  const Vec3 stiffness = Vec3::Constant(weld.position_stiffness);
  const Vec3 push =
      multiplier_step(response, compliance_of(stiffness),
                      state.position[weld.b] - state.position[weld.a], weld_position_[i]);
  move_node(state, weld.a, -a.inverse_mass * push, model.elements[weld.a].length);
  move_node(state, weld.b, b.inverse_mass * push, model.elements[weld.b].length);

  const Quat &qa = state.orientation[weld.a], &qb = state.orientation[weld.b];
  const Mat3 to_a = (qa.conjugate() * qb).toRotationMatrix();
  Mat3 turning = to_a.transpose() * a.inverse_inertia.asDiagonal() * to_a;
  turning.diagonal() += b.inverse_inertia;
  const Vec3 step = multiplier_step(turning, compliance_of(weld.bend_stiffness),
                                    bend_twist(qa, qb, weld.rest_rotation), weld_rotation_[i]);
  turn(state, weld.b, b.inverse_inertia.cwiseProduct(step));
  turn(state, weld.a, -a.inverse_inertia.cwiseProduct(to_a * step));
}

void PositionBasedSolver::project_contact(const RodModel& model, RodState& state, Contact& contact,
                                          double surface_share) {
  const ContactPoint& point = contact.point;
  const int e = model.shapes[point.shape].element;
  const double response = inverse_mass_at(model, e, point.back);
  if (!(response > 0.0)) return;
  const Vec3& n = point.normal_W;
  Vec3 place = point_on(model, state, e, point.back);
  const double compliance = point.stiffness > 0.0 ? 1.0 / (point.stiffness * h_ * h_) : 0.0;
  const double gap = point.gap - point.margin + n.dot(place - contact.found_at);
  const double step = -(gap + compliance * contact.normal) / (response + compliance);
  const double normal = std::max(0.0, contact.normal + step);
  move_place(model, state, e, point.back, (normal - contact.normal) * n);
  contact.normal = normal;

  // Coulomb: pull the place back to where the surface has carried it, as far as friction reaches.
  place = point_on(model, state, e, point.back);
  const Vec3 slide = place - contact.place - surface_share * point.surface_motion_W;
  const Vec3 wanted = contact.tangential - (slide - n.dot(slide) * n) / response;
  const double reach = point.friction * contact.normal;
  const Vec3 tangential = clamped(wanted, reach);
  contact.slipping = wanted.norm() > reach;
  move_place(model, state, e, point.back, tangential - contact.tangential);
  contact.tangential = tangential;
}

void PositionBasedSolver::update_velocities(const RodModel& model, RodState& state) {
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    Body& body = bodies_[e];
    body.velocity = (state.position[e] - body.position) / h_;
    body.spin = log_map(body.orientation.conjugate() * state.orientation[e]) / h_;
  }
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e] || model.elements[e].damping_time <= 0.0) continue;
    damp_stretch(model, state, e);
    damp_bend(model, state, e);
  }
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    state.angular_velocity[e] = bodies_[e].spin;
    // RodState keeps the velocity of the centre of mass.
    const Vec3 arm_E(0, 0, model.elements[e].com_back);
    state.velocity[e] = bodies_[e].velocity - state.orientation[e] * bodies_[e].spin.cross(arm_E);
  }
}

// The impulse against a strain rate, implicit: after it the damper's force goes with the rate that
// is left, so no damping is too strong.
Vec3 PositionBasedSolver::damping_impulse(const Mat3& response, const Vec3& damping,
                                          const Vec3& rate) const {
  Mat3 matrix = response;
  matrix.diagonal() += compliance_of(h_ * damping);
  const Vec3 impulse = -matrix.ldlt().solve(rate);
  return impulse.allFinite() ? impulse : Vec3::Zero();
}

void PositionBasedSolver::damp_stretch(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  Body& body = bodies_[e];
  Body* parent = element.parent < 0 ? nullptr : &bodies_[element.parent];
  const Quat& q = state.orientation[e];
  const Mat3 by_turn = stretch_shear_by_rotation(start_of(model, state, e), state.position[e], q);
  const Vec3 apart = parent ? Vec3(body.velocity - parent->velocity) : body.velocity;
  const Vec3 damping = element.damping_time / element.length * element.stretch_stiffness;
  const Vec3 impulse = damping_impulse(stretch_response(model, e, by_turn), damping,
                                       q.conjugate() * apart + by_turn * body.spin);
  body.velocity += body.inverse_mass * (q * impulse);
  body.spin += body.inverse_inertia.cwiseProduct(by_turn.transpose() * impulse);
  if (parent) parent->velocity -= parent->inverse_mass * (q * impulse);
}

void PositionBasedSolver::damp_bend(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  Body& body = bodies_[e];
  Body* parent = element.parent < 0 ? nullptr : &bodies_[element.parent];
  const Quat& before = parent_rotation(model, state, e);
  const Mat3 to_parent = (before.conjugate() * state.orientation[e]).toRotationMatrix();
  const Vec3 rate = parent ? Vec3(body.spin - to_parent.transpose() * parent->spin) : body.spin;
  const Vec3 impulse = damping_impulse(bend_response(model, e, to_parent),
                                       element.damping_time * element.bend_stiffness, rate);
  body.spin += body.inverse_inertia.cwiseProduct(impulse);
  if (parent) parent->spin -= parent->inverse_inertia.cwiseProduct(to_parent * impulse);
}

void PositionBasedSolver::report_contacts(const RodModel& model, const RodState& state,
                                          StepReport& report) {
  forces_.clear();
  for (const Contact& contact : contacts_) {
    const ContactPoint& point = contact.point;
    const int e = model.shapes[point.shape].element;
    const Vec3 place = point_on(model, state, e, point.back);
    const double gap = point.gap + point.normal_W.dot(place - contact.found_at);
    report.deepest = std::max(report.deepest, -gap);
    if (!(contact.normal > 0.0)) continue;
    ContactForce force;
    force.point = point;
    force.point.gap = gap;
    force.place_W = place - point.radius * point.normal_W;
    force.normal = contact.normal / (h_ * h_);
    force.tangential_W = contact.tangential / (h_ * h_);
    force.slipping = contact.slipping;
    forces_.push_back(force);
  }
  report.contacts = static_cast<int>(forces_.size());
}

}  // namespace pedicel::cosserat
