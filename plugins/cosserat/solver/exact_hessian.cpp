#include "plugins/cosserat/solver/exact_hessian.h"

#include "plugins/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

Mat3 symmetric(const Mat3& m) {
  return 0.5 * (m + m.transpose());
}

Vec3 joint_moment(const RodModel& model, const RodState& state, int e, const Quat& rotation) {
  const Element& element = model.elements[e];
  const Quat& before = element.parent < 0 ? state.root.rotation : state.orientation[element.parent];
  const Vec3 phi = log_map(element.rest_rotation.conjugate() * (before.conjugate() * rotation));
  return rotation *
         Vec3(inverse_right_jacobian(phi).transpose() * element.bend_stiffness.cwiseProduct(phi));
}

// d moment / d rotation vector of the child (W), by central differences: only the joint's own
// stiffness enters, so nothing large cancels.
Mat3 moment_slope(const RodModel& model, const RodState& state, int e) {
  constexpr double step = 1.0e-5;  // rad
  Mat3 slope;
  for (int i = 0; i < 3; ++i) {
    const Quat turn = exp_map(step * Vec3::Unit(i));
    const Quat& q = state.orientation[e];
    slope.col(i) = (joint_moment(model, state, e, turn * q) -
                    joint_moment(model, state, e, turn.conjugate() * q)) /
                   (2.0 * step);
  }
  return slope;
}

// Second derivative of the stretch energy: Gauss-Newton plus force times the second variation of
// the strain, l n . (-(w x d)/l + 1/2 w x (w x along)).
void add_stretch(const RodModel& model, const RodState& state, int e, BlockSystem& system) {
  const Element& element = model.elements[e];
  const double l = element.length;
  const Mat3 r = state.orientation[e].toRotationMatrix();
  const Vec3 along = (state.position[e] - start_of(model, state, e)) / l;
  const Vec3 n = r * joint_load(model, state, e).force;
  const Mat3 s = r * element.stretch_stiffness.asDiagonal() * r.transpose();
  const Mat3 mixed = s * skew(along) - skew(n);
  system.diagonal(e).topLeftCorner<3, 3>() += s / l;
  system.diagonal(e).topRightCorner<3, 3>() += mixed;
  system.diagonal(e).bottomLeftCorner<3, 3>() += mixed.transpose();
  system.diagonal(e).bottomRightCorner<3, 3>() +=
      l * (skew(along).transpose() * s * skew(along)) +
      0.5 * l * (n * along.transpose() + along * n.transpose()) -
      l * n.dot(along) * Mat3::Identity();
  if (element.parent < 0) return;
  system.coupling(e).topLeftCorner<3, 3>() = -s / l;
  system.coupling(e).bottomLeftCorner<3, 3>() = -mixed.transpose();
  system.diagonal(element.parent).topLeftCorner<3, 3>() += s / l;
}

void add_bend(const RodModel& model, const RodState& state, int e, BlockSystem& system) {
  const Mat3 slope = moment_slope(model, state, e);
  const Mat3 moment = skew(joint_moment(model, state, e, state.orientation[e]));
  system.diagonal(e).bottomRightCorner<3, 3>() += symmetric(slope);
  const int p = model.elements[e].parent;
  if (p < 0) return;
  system.coupling(e).bottomRightCorner<3, 3>() = -symmetric(slope) - 0.5 * moment;
  system.diagonal(p).bottomRightCorner<3, 3>() += symmetric(slope + moment);
}

// A dead force at `back` from the child node turns with the element.
void add_dead_force(const RodState& state, int e, double back, const Vec3& force,
                    BlockSystem& system) {
  const Vec3 axis = state.orientation[e] * Vec3::UnitZ();
  system.diagonal(e).bottomRightCorner<3, 3>() += symmetric(back * skew(force) * skew(axis));
}

void add_springs(const RodModel& model, const RodState& state, BlockSystem& system) {
  for (const Support& support : model.supports) {
    const Mat3 r = state.orientation[support.element].toRotationMatrix();
    const Vec3 arm = -support.back * r.col(2);
    add_point_spring(system, support.element, arm, support.position_stiffness * Mat3::Identity(),
                     Vec3::Zero());
    system.diagonal(support.element).bottomRightCorner<3, 3>() +=
        r * support.rotation_stiffness.asDiagonal() * r.transpose();
  }
  for (std::size_t w = 0; w < model.welds.size(); ++w) {
    const Weld& weld = model.welds[w];
    const Mat3 r = state.orientation[weld.b].toRotationMatrix();
    const Mat3 bend = r * weld.bend_stiffness.asDiagonal() * r.transpose();
    Mat6 block = Mat6::Zero();
    block.topLeftCorner<3, 3>() = weld.position_stiffness * Mat3::Identity();
    block.bottomRightCorner<3, 3>() = bend;
    system.diagonal(weld.a) += block;
    system.diagonal(weld.b) += block;
    system.weld(static_cast<int>(w)) = -block;
  }
}

}  // namespace

void add_exact_hessian(const RodModel& model, const RodState& state, const Vec3& gravity,
                       std::span<const Load> loads, BlockSystem& system) {
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) {
      system.diagonal(e).setIdentity();
      continue;
    }
    add_stretch(model, state, e, system);
    add_bend(model, state, e, system);
    const Element& element = model.elements[e];
    add_dead_force(state, e, element.com_back, element.mass * gravity, system);
  }
  for (const Load& load : loads)
    add_dead_force(state, load.element, load.back, load.force_W, system);
  add_springs(model, state, system);
}

}  // namespace pedicel::cosserat
