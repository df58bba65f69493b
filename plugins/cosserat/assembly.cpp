#include "cosserat/assembly.h"

#include <algorithm>

#include "cosserat/rotation.h"

namespace pedicel::cosserat {

namespace {

const Quat& parent_rotation(const RodModel& model, const RodState& state, int e) {
  const int p = model.elements[e].parent;
  return p < 0 ? state.root.rotation : state.orientation[p];
}

Vec3 com_of(const Element& element, const Vec3& position, const Quat& rotation) {
  return position - element.com_back * (rotation * Vec3::UnitZ());
}

// One rotational spring between two frames (or a frame and the world): its moment on the second.
struct Hinge {
  Mat3 hessian;   // N m/rad, W
  Vec3 moment;    // N m, W: on the second frame
  double energy;  // J
};

Hinge hinge(const Quat& relative_to_rest, const Mat3& rotation, const Vec3& stiffness,
            const Vec3& target) {
  const Vec3 phi = log_map(relative_to_rest);
  const Vec3 off = phi - target;
  const Vec3 conjugate = stiffness.cwiseProduct(off);
  const Mat3 b = inverse_right_jacobian(phi) * rotation.transpose();
  const Mat3 scaled = stiffness.asDiagonal() * b;
  return {b.transpose() * scaled, -(b.transpose() * conjugate), 0.5 * off.dot(conjugate)};
}

double hinge_energy(const Quat& relative_to_rest, const Vec3& stiffness, const Vec3& target) {
  const Vec3 off = log_map(relative_to_rest) - target;
  return 0.5 * off.dot(stiffness.cwiseProduct(off));
}

}  // namespace

Assembly::Assembly(const RodModel& model)
    : terms_(model.elements.size()),
      com_past_(model.elements.size(), Vec3::Zero()),
      rotation_past_(model.elements.size(), Quat::Identity()),
      moment_reference_(model.elements.size(), Quat::Identity()) {}

void Assembly::prepare(const RodModel& model, const RodState& start, const StepInput& input,
                       bool first_order) {
  // past = a (this step's start) - b (the step before's), scaled so that x = past + h~ x'.
  const double a = first_order ? 1.0 : 4.0 / 3.0, b = first_order ? 0.0 : 1.0 / 3.0;
  step_ = input.dt * (first_order ? 1.0 : 2.0 / 3.0);
  loads_ = input.loads;
  moment_reference_ = start.orientation;
  for (int e = 0; e < model.size(); ++e) {
    if (!start.alive[e]) continue;
    const Element& element = model.elements[e];
    ElementTerms& t = terms_[e];
    const Vec3 com = com_of(element, start.position[e], start.orientation[e]);
    const Vec3 com_before =
        com_of(element, start.previous_position[e], start.previous_orientation[e]);
    const Vec3 turn = log_map(start.previous_orientation[e].conjugate() * start.orientation[e]);
    const Vec3 velocity = a * start.velocity[e] - b * start.previous_velocity[e];
    const Vec3 spin = a * start.angular_velocity[e] - b * start.previous_angular_velocity[e];
    // Euler's equations in E: the gyroscopic torque enters explicitly, extrapolated.
    const Vec3 now =
        first_order ? start.angular_velocity[e]
                    : Vec3(2.0 * start.angular_velocity[e] - start.previous_angular_velocity[e]);
    const Vec3 gyroscopic =
        now.cross(element.inertia.cwiseProduct(now)).cwiseQuotient(element.inertia);

    com_past_[e] = a * com - b * com_before;
    rotation_past_[e] = start.orientation[e] * exp_map(b * turn);
    const double drag = 1.0 + element.mass_damping * step_;
    t.com_target = com_past_[e] + step_ / drag * velocity;
    t.rotation_target = rotation_past_[e] * exp_map(step_ / drag * (spin - step_ * gyroscopic));
    t.inertia_weight = element.mass * drag / (step_ * step_);
    t.rotation_weight = element.inertia * (drag / (step_ * step_));
    t.weight = element.mass * input.gravity;

    const double viscous = element.damping_time / step_;
    t.stretch_stiffness = (1.0 + viscous) * element.stretch_stiffness;
    t.bend_stiffness = (1.0 + viscous) * element.bend_stiffness;
    t.stretch_target.setZero();
    t.bend_target.setZero();
    if (viscous > 0.0) {
      const Strain strain = strain_of(model, start, e);
      const double share = viscous / (1.0 + viscous);
      t.stretch_target = share * (a * strain.stretch - b * start.previous_stretch[e]);
      t.bend_target = share * (a * strain.bend - b * start.previous_bend[e]);
    }
  }
}

double Assembly::linearise(const RodModel& model, const RodState& state, BlockSystem& system) {
  system.clear();
  moment_reference_ = state.orientation;
  return sum(model, state, &system);
}

double Assembly::potential(const RodModel& model, const RodState& state) const {
  return sum(model, state, nullptr);
}

double Assembly::sum(const RodModel& model, const RodState& state, BlockSystem* system) const {
  double energy = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    if (state.alive[e]) {
      energy += rod(model, state, e, system) + inertia(model, state, e, system);
    } else if (system) {
      system->diagonal(e).setIdentity();
    }
  }
  for (const Load& one : loads_)
    if (state.alive[one.element]) energy += load(state, one, system);
  for (const Support& one : model.supports)
    if (state.alive[one.element]) energy += support(state, one, system);
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w)
    if (state.alive[model.welds[w].a] && state.alive[model.welds[w].b])
      energy += weld(model, state, w, system);
  return energy;
}

double Assembly::rod(const RodModel& model, const RodState& state, int e,
                     BlockSystem* system) const {
  const Element& element = model.elements[e];
  const ElementTerms& t = terms_[e];
  const double l = element.length;
  const Mat3 r = state.orientation[e].toRotationMatrix();
  const Vec3 along = (state.position[e] - start_of(model, state, e)) / l;
  const Vec3 strain =
      r.transpose() * along - Vec3::UnitZ() - element.rest_strain - t.stretch_target;
  const Vec3 force_E = t.stretch_stiffness.cwiseProduct(strain);
  const Quat relative = element.rest_rotation.conjugate() *
                        (parent_rotation(model, state, e).conjugate() * state.orientation[e]);
  const double stretch_energy = 0.5 * l * strain.dot(force_E);
  if (!system) return stretch_energy + hinge_energy(relative, t.bend_stiffness, t.bend_target);

  const Hinge bend = hinge(relative, r, t.bend_stiffness, t.bend_target);
  const Vec3 force = r * force_E;
  const Mat3 s = r * t.stretch_stiffness.asDiagonal() * r.transpose();
  const Mat3 s_lever = s * skew(along);
  const Vec3 axis = r.col(2);
  const double tension = std::max(force_E.z(), 0.0) * l;

  Mat6& own = system->diagonal(e);
  own.topLeftCorner<3, 3>() += s / l;
  own.topRightCorner<3, 3>() += s_lever;
  own.bottomLeftCorner<3, 3>() += s_lever.transpose();
  own.bottomRightCorner<3, 3>() += l * (skew(along).transpose() * s_lever) + bend.hessian +
                                   tension * (Mat3::Identity() - axis * axis.transpose());
  Vec6& right = system->right_side(e);
  right.head<3>() -= force;
  right.tail<3>() += l * along.cross(force) + bend.moment;
  if (element.parent >= 0) {
    Mat6& to_parent = system->coupling(e);
    to_parent.topLeftCorner<3, 3>() = -s / l;
    to_parent.bottomLeftCorner<3, 3>() = -s_lever.transpose();
    to_parent.bottomRightCorner<3, 3>() = -bend.hessian;
    Mat6& parent = system->diagonal(element.parent);
    parent.topLeftCorner<3, 3>() += s / l;
    parent.bottomRightCorner<3, 3>() += bend.hessian;
    Vec6& parent_right = system->right_side(element.parent);
    parent_right.head<3>() += force;
    parent_right.tail<3>() -= bend.moment;
  }
  return stretch_energy + bend.energy;
}

double Assembly::inertia(const RodModel& model, const RodState& state, int e,
                         BlockSystem* system) const {
  const Element& element = model.elements[e];
  const ElementTerms& t = terms_[e];
  const Mat3 r = state.orientation[e].toRotationMatrix();
  const Vec3 arm = -element.com_back * r.col(2);
  const Vec3 com = state.position[e] + arm;
  const Vec3 off = com - t.com_target;
  Quat turn = t.rotation_target.conjugate() * state.orientation[e];
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const Vec3 phi = 2.0 * turn.vec();
  const Vec3 conjugate = t.rotation_weight.cwiseProduct(phi);
  if (system) {
    add_point_spring(*system, e, arm, t.inertia_weight * Mat3::Identity(),
                     t.weight - t.inertia_weight * off);
    // phi = 2 vec(q~^-1 q) changes by (w I + [v]) R^T per unit of rotation.
    const Vec3 moment_E = turn.w() * conjugate - turn.vec().cross(conjugate);
    system->diagonal(e).bottomRightCorner<3, 3>() +=
        r * t.rotation_weight.asDiagonal() * r.transpose();
    system->right_side(e).tail<3>() -= r * moment_E;
  }
  return 0.5 * t.inertia_weight * off.squaredNorm() + 0.5 * phi.dot(conjugate) -
         t.weight.dot(com - com_past_[e]);
}

double Assembly::load(const RodState& state, const Load& load, BlockSystem* system) const {
  const int e = load.element;
  const Vec3 arm = -load.back * (state.orientation[e] * Vec3::UnitZ());
  if (system) {
    system->right_side(e).head<3>() += load.force_W;
    system->right_side(e).tail<3>() += arm.cross(load.force_W) + load.moment_W;
  }
  const Vec3 turned = log_map(state.orientation[e] * moment_reference_[e].conjugate());
  return -load.force_W.dot(state.position[e] + arm - com_past_[e]) - load.moment_W.dot(turned);
}

double Assembly::support(const RodState& state, const Support& support, BlockSystem* system) const {
  const int e = support.element;
  const Mat3 r = state.orientation[e].toRotationMatrix();
  const Vec3 arm = -support.back * r.col(2);
  const Vec3 off = state.position[e] + arm - support.position;
  const double k = support.position_stiffness;
  const Hinge spring = hinge(support.rotation.conjugate() * state.orientation[e], r,
                             support.rotation_stiffness, Vec3::Zero());
  if (system) {
    add_point_spring(*system, e, arm, k * Mat3::Identity(), -k * off);
    system->diagonal(e).bottomRightCorner<3, 3>() += spring.hessian;
    system->right_side(e).tail<3>() += spring.moment;
  }
  return 0.5 * k * off.squaredNorm() + spring.energy;
}

double Assembly::weld(const RodModel& model, const RodState& state, int index,
                      BlockSystem* system) const {
  const Weld& weld = model.welds[index];
  const Vec3 gap = state.position[weld.b] - state.position[weld.a];
  const double k = weld.position_stiffness;
  const Hinge spring =
      hinge(weld.rest_rotation.conjugate() *
                (state.orientation[weld.a].conjugate() * state.orientation[weld.b]),
            state.orientation[weld.b].toRotationMatrix(), weld.bend_stiffness, Vec3::Zero());
  if (system) {
    for (const int e : {weld.a, weld.b}) {
      const double sign = e == weld.a ? -1.0 : 1.0;
      system->diagonal(e).topLeftCorner<3, 3>().diagonal().array() += k;
      system->diagonal(e).bottomRightCorner<3, 3>() += spring.hessian;
      system->right_side(e).head<3>() -= sign * k * gap;
      system->right_side(e).tail<3>() += sign * spring.moment;
    }
    system->weld(index).topLeftCorner<3, 3>() = -k * Mat3::Identity();
    system->weld(index).bottomRightCorner<3, 3>() = -spring.hessian;
  }
  return 0.5 * k * gap.squaredNorm() + spring.energy;
}

void Assembly::set_velocities(const RodModel& model, RodState& end) const {
  for (int e = 0; e < model.size(); ++e) {
    if (!end.alive[e]) continue;
    const Vec3 com = com_of(model.elements[e], end.position[e], end.orientation[e]);
    end.velocity[e] = (com - com_past_[e]) / step_;
    end.angular_velocity[e] = log_map(rotation_past_[e].conjugate() * end.orientation[e]) / step_;
  }
}

}  // namespace pedicel::cosserat
