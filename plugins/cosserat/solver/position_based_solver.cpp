#include "plugins/cosserat/solver/position_based_solver.h"

#include <algorithm>
#include <cmath>

#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/position_based_constraints.h"

namespace pedicel::cosserat {

PositionBasedSolver::PositionBasedSolver(const RodSettings& settings, const RodModel& model)
    : settings_(settings), projections_(model) {
  // Room for a shape between two fingers: a step must not allocate.
  const std::size_t contacts = 2 * model.shapes.size();
  found_.reserve(contacts);
  contacts_.reserve(contacts);
  forces_.reserve(contacts);
}

StepReport PositionBasedSolver::step(const RodModel& model, RodState& state,
                                     const StepInput& input) {
  StepReport report;
  // The whole step is undone where a number is no number any more, whichever substep made it.
  remember(state);
  // Once a step and not once a sub-step: colliders stand at their end-of-step poses, and their way
  // is followed over the whole step. Each sub-step takes its share of the motion in the sweep.
  for (ContactSource* source : input.contacts) source->begin_step(model, state, input.dt);
  // Once a step as well: fruits come off between steps only, so masses do not change within one.
  // The nodes' velocities that it sets are carried from sub-step to sub-step by the bodies; the
  // state's own are written over in each, and not read again.
  share_masses(model, state);
  const int substeps = std::max(1, settings_.substeps);
  h_ = input.dt / substeps;
  for (int s = 0; s < substeps; ++s) {
    // The order is the paper's: predict, find contacts, project, and take velocities from the
    // difference.
    gather_loads(model, state, input);
    predict(model, state);
    // Before contacts: the multipliers of a sub-step start at zero, as the compliance belongs to
    // what they add up to in it.
    projections_.begin(h_);
    find_contacts(model, state, input);
    for (int i = 0; i < settings_.iterations; ++i)
      projections_.sweep(model, state, contacts_, 1.0 / substeps);
    update_velocities(model, state);
  }
  report.iterations = substeps * settings_.iterations;
  // No `not_converged` here: a few sweeps never converge, and the paper lives with that. The last
  // correction says how far away they were.
  report.last_change = projections_.change().size;
  report.element = projections_.change().element;
  const auto finite = [](const Vec3& p) { return p.allFinite(); };
  // Orientations are normalised and their corrections clamped, so what is lost shows in positions
  // and velocities.
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
    // Lever rule: the mass goes to the two nodes so that its centre stays. A fruit that hangs
    // beyond the segment's end would want a negative mass at the other node, and is held to the
    // end.
    const double near = std::clamp(element.com_back / element.length, 0.0, 1.0);
    bodies[e].node_mass += (1.0 - near) * element.mass;
    // At the clamp the share is lost to it: the clamp's node does not move, whatever its mass.
    if (element.parent >= 0) bodies[element.parent].node_mass += near * element.mass;
    // The method moves nodes, while the state keeps velocities of centres of mass. The way back is
    // at the end of update_velocities().
    bodies[e].velocity = velocity_on(model, state, e, 0.0);
  }
  // Inverses after all sums: a node's mass is whole only when its children have added theirs. What
  // came off has an inverse of zero, and nothing moves it.
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
    // On nodes, as the masses are: what a segment weighs is then right, and so is its moment about
    // either node.
    body.force = body.node_mass * input.gravity;
    body.moment.setZero();
  }
  for (const Load& load : input.loads) {
    if (!state.alive[load.element]) continue;
    const Element& element = model.elements[load.element];
    // The same lever rule as for masses, so that a force off the nodes turns the segment as it
    // should.
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
    // Kept before anything moves: velocities are differences from here, and friction's slide is,
    // too.
    body.position = state.position[e];
    body.orientation = state.orientation[e];
    if (!state.alive[e]) continue;
    const Element& element = model.elements[e];
    // Implicit: explicit damping with a long sub-step would turn the velocity round.
    const double kept = 1.0 / (1.0 + h_ * element.mass_damping);
    body.velocity = kept * (body.velocity + h_ * body.inverse_mass * body.force);
    state.position[e] += h_ * body.velocity;

    const Vec3& omega = state.angular_velocity[e];
    // Euler's equations in E, where the inertia is diagonal and constant.
    const Vec3 gyroscopic = omega.cross(element.inertia.cwiseProduct(omega));
    const Vec3 moment = state.orientation[e].conjugate() * body.moment - gyroscopic;
    const Vec3 next = kept * (omega + h_ * body.inverse_inertia.cwiseProduct(moment));
    // Clamped as the corrections are, so that a light segment that spins fast does not overflow.
    // Normalised, since products of quaternions drift.
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
      // Where the touching place was when the sub-step began. Friction wants the way from there.
      contact.place = (1.0 - t) * bodies[e].position + t * near;
      // Where the plane was found. Within the sub-step the gap is linear from here, as no contact
      // is looked for between sweeps.
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
    // From where the sweeps ended and not from the prediction: that is how corrections become
    // impulses.
    body.velocity = (state.position[e] - body.position) / h_;
    body.spin = log_map(body.orientation.conjugate() * state.orientation[e]) / h_;
  }
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e] || model.elements[e].damping_time <= 0.0) continue;
    // After all velocities are known, since a joint's rate takes the parent's; from the root
    // outward.
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
    // The plane's gap where the plant ended, not where the contact was found.
    const double gap = point.gap + point.normal_W.dot(place - contact.found_at);
    report.deepest = std::max(report.deepest, -gap);
    // Contacts never pull: a multiplier of zero is one that was found and not needed.
    if (!(contact.normal > 0.0)) continue;
    ContactForce force;
    force.point = point;
    force.point.gap = gap;
    // On the surface. The projection works on the centreline, and only the report shows where it
    // touched.
    force.place_W = place - point.radius * point.normal_W;
    // A multiplier is mass times way. Over h squared it is a force; of the last sub-step only.
    force.normal = contact.normal / (h_ * h_);
    force.tangential_W = contact.tangential / (h_ * h_);
    force.slipping = contact.slipping;
    forces_.push_back(force);
  }
  report.contacts = static_cast<int>(forces_.size());
}

}  // namespace pedicel::cosserat
