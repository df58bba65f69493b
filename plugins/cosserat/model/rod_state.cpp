#include "plugins/cosserat/model/rod_state.h"

#include <cmath>

#include "plugins/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

const Quat& parent_rotation(const RodModel& model, const RodState& state, int element) {
  const int parent = model.elements[element].parent;
  return parent < 0 ? state.root.rotation : state.orientation[parent];
}

// As log_map(), to rounding. Below 0.4 rad the arctangent is a series, which takes a third of the
// time: energies are summed up over all elements in each step.
Vec3 quick_log_map(const Quat& q) {
  const double w = std::abs(q.w());
  const double scale = std::copysign(4.0, q.w()) / (1.0 + w);
  const double z = q.vec().squaredNorm() / ((1.0 + w) * (1.0 + w));  // of a quarter's tangent
  if (z > 0.01) return log_map(q);
  double series = -1.0 / 15.0;
  series = 1.0 / 13.0 + z * series;
  series = -1.0 / 11.0 + z * series;
  series = 1.0 / 9.0 + z * series;
  series = -1.0 / 7.0 + z * series;
  series = 1.0 / 5.0 + z * series;
  series = -1.0 / 3.0 + z * series;
  series = 1.0 + z * series;
  return scale * series * q.vec();
}

double elastic_energy(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  const Vec3 stretch = stretch_of(model, state, e);
  const Vec3 bend = quick_log_map(turn_of(model, state, e));
  return 0.5 * element.length * stretch.dot(element.stretch_stiffness.cwiseProduct(stretch)) +
         0.5 * bend.dot(element.bend_stiffness.cwiseProduct(bend));
}

double extended_elastic_energy(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  const Strain strain = strain_of(model, state, e);
  return 0.5 * stiffness_factor(model, state.time) * element.length *
             strain.stretch.dot(element.stretch_stiffness.cwiseProduct(strain.stretch)) +
         joint_response(model, state, e, strain.bend).energy;
}

double support_energy(const RodState& state, const Support& support) {
  if (!state.alive[support.element]) return 0.0;
  const Vec3 axis = state.orientation[support.element] * Vec3::UnitZ();
  const Vec3 gap = state.position[support.element] - support.back * axis - support.position;
  const Vec3 phi = log_map(support.rotation.conjugate() * state.orientation[support.element]);
  return 0.5 * support.position_stiffness * gap.squaredNorm() +
         0.5 * phi.dot(support.rotation_stiffness.cwiseProduct(phi));
}

}  // namespace

RodState drawn_state(const RodModel& model) {
  RodState state;
  for (const Element& element : model.elements) {
    state.position.push_back(element.drawn_position);
    state.orientation.push_back(element.drawn_rotation);
  }
  const std::size_t n = model.elements.size();
  state.velocity.assign(n, Vec3::Zero());
  state.angular_velocity.assign(n, Vec3::Zero());
  state.alive.assign(n, 1);
  state.fruit_gone.assign(model.fruits.size(), false);
  state.root = state.previous_root = model.root;
  return state;
}

Vec3 start_of(const RodModel& model, const RodState& state, int element) {
  const int parent = model.elements[element].parent;
  return parent < 0 ? state.root.position : state.position[parent];
}

Vec3 point_on(const RodModel& model, const RodState& state, int element, double back) {
  const double t = back / model.elements[element].length;
  return (1.0 - t) * state.position[element] + t * start_of(model, state, element);
}

Vec3 velocity_on(const RodModel& model, const RodState& state, int element, double back) {
  const Quat& q = state.orientation[element];
  const Vec3 arm_E(0, 0, model.elements[element].com_back - back);
  return state.velocity[element] + q * state.angular_velocity[element].cross(arm_E);
}

Vec3 stretch_of(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  const Vec3 along = (state.position[e] - start_of(model, state, e)) / element.length;
  return state.orientation[e].conjugate() * along - Vec3::UnitZ() - element.rest_strain;
}

Quat turn_of(const RodModel& model, const RodState& state, int e) {
  return model.elements[e].rest_rotation.conjugate() *
         (parent_rotation(model, state, e).conjugate() * state.orientation[e]);
}

Strain strain_of(const RodModel& model, const RodState& state, int e) {
  return {stretch_of(model, state, e), log_map(turn_of(model, state, e))};
}

JointLoad joint_load(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  const Strain strain = strain_of(model, state, e);
  if (is_extended(model)) {
    return {stiffness_factor(model, state.time) *
                element.stretch_stiffness.cwiseProduct(strain.stretch),
            inverse_right_jacobian(strain.bend).transpose() *
                joint_response(model, state, e, strain.bend).moment};
  }
  const Vec3 conjugate = element.bend_stiffness.cwiseProduct(strain.bend);
  return {element.stretch_stiffness.cwiseProduct(strain.stretch),
          inverse_right_jacobian(strain.bend).transpose() * conjugate};
}

Energy energy_of(const RodModel& model, const RodState& state, const Vec3& gravity) {
  Energy energy;
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    const Element& element = model.elements[e];
    const Vec3& omega = state.angular_velocity[e];
    energy.kinetic += 0.5 * element.mass * state.velocity[e].squaredNorm() +
                      0.5 * omega.dot(element.inertia.cwiseProduct(omega));
    energy.elastic += is_extended(model) ? extended_elastic_energy(model, state, e)
                                         : elastic_energy(model, state, e);
    const Vec3 com = state.position[e] - element.com_back * (state.orientation[e] * Vec3::UnitZ());
    energy.gravity -= element.mass * gravity.dot(com);
  }
  for (const Support& support : model.supports) energy.elastic += support_energy(state, support);
  for (const Weld& weld : model.welds) {
    if (!state.alive[weld.a] || !state.alive[weld.b]) continue;
    const Vec3 gap = state.position[weld.b] - state.position[weld.a];
    const Vec3 phi =
        quick_log_map(weld.rest_rotation.conjugate() *
                      (state.orientation[weld.a].conjugate() * state.orientation[weld.b]));
    energy.elastic += 0.5 * weld.position_stiffness * gap.squaredNorm() +
                      0.5 * phi.dot(weld.bend_stiffness.cwiseProduct(phi));
  }
  return energy;
}

}  // namespace pedicel::cosserat
