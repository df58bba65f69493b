#include "pedicel/cosserat/solver/position_based_solver.h"

#include <algorithm>
#include <cmath>

#include "pedicel/cosserat/model/rotation.h"
#include "pedicel/cosserat/solver/position_based_constraints.h"

namespace pedicel::cosserat {

PositionBasedSolver::PositionBasedSolver(const RodSettings& settings, const RodModel& model)
    : settings_(settings), projections_(model) {
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
    projections_.begin(h_);
    find_contacts(model, state, input);
    for (int i = 0; i < settings_.iterations; ++i)
      projections_.sweep(model, state, contacts_, 1.0 / substeps);
    update_velocities(model, state);
  }
  report.iterations = substeps * settings_.iterations;
  report.last_change = projections_.change().size;
  report.element = projections_.change().element;
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
  std::vector<Body>& bodies = projections_.bodies();
  for (Body& body : bodies) body.node_mass = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    if (!state.alive[e]) continue;
    const double near = std::clamp(element.com_back / element.length, 0.0, 1.0);
    bodies[e].node_mass += (1.0 - near) * element.mass;
    if (element.parent >= 0) bodies[element.parent].node_mass += near * element.mass;
    bodies[e].velocity = velocity_on(model, state, e, 0.0);
  }
  for (int e = 0; e < model.size(); ++e) {
    Body& body = bodies[e];
    body.inverse_mass = body.node_mass > 0.0 ? 1.0 / body.node_mass : 0.0;
    body.inverse_inertia =
        state.alive[e] ? Vec3(model.elements[e].inertia.cwiseInverse()) : Vec3::Zero();
  }
}

void PositionBasedSolver::gather_loads(const RodModel& model, const RodState& state,
                                       const StepInput& input) {
  std::vector<Body>& bodies = projections_.bodies();
  for (Body& body : bodies) {
    body.force = body.node_mass * input.gravity;
    body.moment.setZero();
  }
  for (const Load& load : input.loads) {
    if (!state.alive[load.element]) continue;
    const Element& element = model.elements[load.element];
    const double near = load.back / element.length;
    bodies[load.element].force += (1.0 - near) * load.force_W;
    bodies[load.element].moment += load.moment_W;
    if (element.parent >= 0) bodies[element.parent].force += near * load.force_W;
  }
}

void PositionBasedSolver::predict(const RodModel& model, RodState& state) {
  std::vector<Body>& bodies = projections_.bodies();
  for (int e = 0; e < model.size(); ++e) {
    Body& body = bodies[e];
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

void PositionBasedSolver::find_contacts(const RodModel& model, const RodState& state,
                                        const StepInput& input) {
  const std::vector<Body>& bodies = projections_.bodies();
  contacts_.clear();
  for (ContactSource* source : input.contacts) {
    found_.clear();
    source->find(model, state, input.dt, found_);
    for (const ContactPoint& point : found_) {
      const int e = model.shapes[point.shape].element, parent = model.elements[e].parent;
      if (!state.alive[e]) continue;
      const double t = point.back / model.elements[e].length;
      const Vec3& near = parent < 0 ? state.root.position : bodies[parent].position;
      Contact contact;
      contact.point = point;
      contact.place = (1.0 - t) * bodies[e].position + t * near;
      contact.found_at = point_on(model, state, e, point.back);
      contacts_.push_back(contact);
    }
  }
}

void PositionBasedSolver::update_velocities(const RodModel& model, RodState& state) {
  std::vector<Body>& bodies = projections_.bodies();
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    Body& body = bodies[e];
    body.velocity = (state.position[e] - body.position) / h_;
    body.spin = log_map(body.orientation.conjugate() * state.orientation[e]) / h_;
  }
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e] || model.elements[e].damping_time <= 0.0) continue;
    projections_.damp(model, state, e);
  }
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    state.angular_velocity[e] = bodies[e].spin;
    // RodState keeps the velocity of the centre of mass.
    const Vec3 arm_E(0, 0, model.elements[e].com_back);
    state.velocity[e] = bodies[e].velocity - state.orientation[e] * bodies[e].spin.cross(arm_E);
  }
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
