#include "pedicel/cosserat/model/stalk_load.h"

#include "pedicel/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

// 1/s and rad/s, in E: how fast the strains of a joint change.
Strain strain_rate_of(const RodModel& model, const RodState& state, int e, const Vec3& bend) {
  const Element& element = model.elements[e];
  const Quat back = state.orientation[e].conjugate();
  const Vec3& own = state.angular_velocity[e];
  const Vec3 along = (state.position[e] - start_of(model, state, e)) / element.length;
  Vec3 grows = velocity_on(model, state, e, 0.0), turns = own;
  if (element.parent >= 0) {
    grows -= velocity_on(model, state, element.parent, 0.0);
    turns -= back * (state.orientation[element.parent] * state.angular_velocity[element.parent]);
  }
  return {back * grows / element.length - own.cross(back * along),
          inverse_right_jacobian(bend) * turns};
}

}  // namespace

JointLoad stalk_load(const RodModel& model, const RodState& state, int e) {
  const Element& element = model.elements[e];
  JointLoad load = joint_load(model, state, e);
  // By the elastic part alone a stalk that is pulled evenly would part later by the damping time.
  if (element.damping_time == 0.0) return load;
  const Vec3 bend = strain_of(model, state, e).bend;
  const Strain rate = strain_rate_of(model, state, e, bend);
  load.force += element.damping_time * element.stretch_stiffness.cwiseProduct(rate.stretch);
  load.moment += element.damping_time * (inverse_right_jacobian(bend).transpose() *
                                         element.bend_stiffness.cwiseProduct(rate.bend));
  return load;
}

}  // namespace pedicel::cosserat
