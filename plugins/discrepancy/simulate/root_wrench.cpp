#include "pedicel/discrepancy/simulate/root_wrench.h"

#include "pedicel/cosserat/model/rotation.h"

namespace pedicel::discrepancy {

namespace {

struct StrainRate {
  Vec3 stretch, bend;  // 1/s and rad/s, E
};

StrainRate rate_of(const cosserat::RodModel& model, const cosserat::RodState& state, int e,
                   const Vec3& bend, const RootMotion& root) {
  const cosserat::Element& element = model.elements[e];
  const Quat& q = state.orientation[e];
  const Vec3& own = state.angular_velocity[e];
  const Vec3 along = (state.position[e] - state.root.position) / element.length;
  const Vec3 grows = (cosserat::velocity_on(model, state, e, 0.0) - root.velocity) / element.length;
  const Vec3 turning = own - q.conjugate() * root.turning;
  return {q.conjugate() * Vec3(grows - (q * own).cross(along)),
          cosserat::inverse_right_jacobian(bend) * turning};
}

}  // namespace

Eigen::Matrix<double, 6, 1> root_wrench(const cosserat::RodModel& model,
                                        const cosserat::RodState& state, const RootMotion& root) {
  Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& element = model.elements[e];
    if (element.parent >= 0 || !state.alive[e]) continue;
    const Vec3 bend = cosserat::strain_of(model, state, e).bend;
    const StrainRate rate = rate_of(model, state, e, bend, root);
    cosserat::JointLoad load = cosserat::joint_load(model, state, e);
    load.force += element.damping_time * element.stretch_stiffness.cwiseProduct(rate.stretch);
    load.moment += element.damping_time * (cosserat::inverse_right_jacobian(bend).transpose() *
                                           element.bend_stiffness.cwiseProduct(rate.bend));
    wrench.head<3>() -= state.orientation[e] * load.force;
    wrench.tail<3>() -= state.orientation[e] * load.moment;
  }
  return wrench;
}

}  // namespace pedicel::discrepancy
