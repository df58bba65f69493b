#include "plugins/discrepancy/scene/giving_joints.h"

namespace pedicel::discrepancy {

namespace {
// Of Newmark's method, of second order but for a damping of 5 % of a step's turn: contact that
// begins would ring on for ever.
constexpr double speed_share = 0.55, place_share = 0.276;
}  // namespace

GivingJoints::GivingJoints(const Arm& arm, const SceneState& state, double dt)
    : dt_(dt), stiffness_(state.joint_stiffness) {
  const long dofs = arm.model().dofs();
  effort_ = deflection_ = speed_ = acceleration_ = Eigen::VectorXd::Zero(dofs);
  free_deflection_ = free_speed_ = deflection_;
  compliance_.setZero(dofs, dofs);
  if (!give()) return;
  damping_ = state.joint_damping_time * stiffness_;
  dynamics_.emplace(arm.description(), arm.model());
}

void GivingJoints::begin_step(const Eigen::VectorXd& q) {
  if (!give()) return;
  free_deflection_ = deflection_ + dt_ * speed_ + dt_ * dt_ * (0.5 - place_share) * acceleration_;
  free_speed_ = speed_ + dt_ * (1.0 - speed_share) * acceleration_;
  Eigen::MatrixXd inertia = dynamics_->mass_matrix(q);
  inertia.diagonal().array() += speed_share * dt_ * damping_ + place_share * dt_ * dt_ * stiffness_;
  compliance_ = place_share * dt_ * dt_ * inertia.inverse();
  solve();
}

void GivingJoints::end_step(const Eigen::VectorXd& effort) {
  if (!give()) return;
  effort_ = effort;
  solve();
}

void GivingJoints::solve() {
  const Eigen::VectorXd turned =
      compliance_ * (effort_ - damping_ * free_speed_ - stiffness_ * free_deflection_);
  acceleration_ = turned / (place_share * dt_ * dt_);
  deflection_ = free_deflection_ + turned;
  speed_ = free_speed_ + speed_share * dt_ * acceleration_;
}

Eigen::RowVectorXd GivingJoints::row() const {
  Eigen::RowVectorXd all(3 * deflection_.size());
  all << deflection_.transpose(), speed_.transpose(), acceleration_.transpose();
  return all;
}

}  // namespace pedicel::discrepancy
