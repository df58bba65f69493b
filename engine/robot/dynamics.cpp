#include "engine/robot/dynamics.h"

namespace pedicel::robot {

Dynamics::Dynamics(const RobotDescription& robot, const KinematicModel& model) : model_(model) {
  for (const Link& link : robot.links) inertials_.push_back(link.inertial);
  poses_.resize(inertials_.size());
  twists_.resize(inertials_.size());
  states_.resize(inertials_.size());
  element_torques_.resize(inertials_.size());
  torques_.setZero(model.dofs());
  resting_ = one_ = torques_;
  mass_.setZero(model.dofs(), model.dofs());
}

void Dynamics::forward(const Eigen::VectorXd& qd, const Eigen::VectorXd& qdd) {
  for (const KinematicModel::Element& e : model_.elements()) {
    LinkState& state = states_[e.link];
    if (e.parent < 0) {
      state.angular_acceleration = state.acceleration = Vec3::Zero();
      continue;
    }
    const LinkState& parent = states_[e.parent];
    const Vec3& omega = twists_[e.parent].angular;
    const Vec3 arm = poses_[e.link].position - poses_[e.parent].position;
    state.angular_acceleration = parent.angular_acceleration;
    state.acceleration = parent.acceleration + parent.angular_acceleration.cross(arm) +
                         omega.cross(omega.cross(arm));
    if (e.dof < 0) continue;
    const Vec3 axis = poses_[e.link].rotation * e.axis * e.multiplier;
    const Vec3 own = axis * qdd[e.dof] + omega.cross(axis * qd[e.dof]);
    if (e.type == JointType::prismatic)
      state.acceleration += own + omega.cross(axis * qd[e.dof]);
    else
      state.angular_acceleration += own;
  }
}

void Dynamics::own_forces(const Vec3& gravity_W) {
  for (std::size_t i = 0; i < inertials_.size(); ++i) {
    LinkState& state = states_[i];
    const Inertial& body = inertials_[i];
    const Mat3 rotation = poses_[i].rotation.toRotationMatrix();
    const Mat3 inertia = rotation * body.inertia * rotation.transpose();
    const Vec3& omega = twists_[i].angular;
    const Vec3 com = rotation * body.com_L;
    const Vec3 acceleration =
        state.acceleration + state.angular_acceleration.cross(com) + omega.cross(omega.cross(com));
    state.force = body.mass * (acceleration - gravity_W);
    state.moment = inertia * state.angular_acceleration + omega.cross(inertia * omega) +
                   com.cross(state.force);
  }
}

void Dynamics::backward() {
  torques_.setZero();
  const auto& elements = model_.elements();
  for (std::size_t i = elements.size(); i-- > 0;) {
    const KinematicModel::Element& e = elements[i];
    const LinkState& state = states_[e.link];
    element_torques_[i] = 0.0;
    if (e.parent < 0) continue;
    LinkState& parent = states_[e.parent];
    const Vec3 arm = poses_[e.link].position - poses_[e.parent].position;
    parent.force += state.force;
    parent.moment += state.moment + arm.cross(state.force);
    if (e.dof < 0) continue;
    const Vec3 axis = poses_[e.link].rotation * e.axis;
    element_torques_[i] = axis.dot(e.type == JointType::prismatic ? state.force : state.moment);
    torques_[e.dof] += e.multiplier * element_torques_[i];
  }
}

const Eigen::VectorXd& Dynamics::inverse(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                                         const Eigen::VectorXd& qdd, const Vec3& gravity_W,
                                         std::span<const LinkForce> forces) {
  model_.link_poses(q, poses_);
  model_.link_velocities(poses_, qd, twists_);
  forward(qd, qdd);
  own_forces(gravity_W);
  for (const LinkForce& f : forces) {
    states_[f.link].force -= f.force_W;
    states_[f.link].moment -= (f.point_W - poses_[f.link].position).cross(f.force_W);
  }
  backward();
  return torques_;
}

Wrench Dynamics::carried_wrench(int link) const {
  const auto l = static_cast<std::size_t>(link);
  const Quat back = poses_[l].rotation.conjugate();
  Wrench wrench;
  wrench << back * -states_[l].force, back * -states_[l].moment;
  return wrench;
}

const Eigen::MatrixXd& Dynamics::mass_matrix(const Eigen::VectorXd& q) {
  for (int i = 0; i < mass_.cols(); ++i) {
    one_.setZero();
    one_[i] = 1.0;
    mass_.col(i) = inverse(q, resting_, one_, Vec3::Zero());
  }
  return mass_;
}

double Dynamics::kinetic_energy(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  model_.link_poses(q, poses_);
  model_.link_velocities(poses_, qd, twists_);
  double energy = 0.0;
  for (std::size_t i = 0; i < inertials_.size(); ++i) {
    const Mat3 rotation = poses_[i].rotation.toRotationMatrix();
    const Vec3 omega_L = rotation.transpose() * twists_[i].angular;
    const Vec3 velocity =
        twists_[i].linear + twists_[i].angular.cross(rotation * inertials_[i].com_L);
    energy += 0.5 * inertials_[i].mass * velocity.squaredNorm() +
              0.5 * omega_L.dot(inertials_[i].inertia * omega_L);
  }
  return energy;
}

double Dynamics::potential_energy(const Eigen::VectorXd& q, const Vec3& gravity_W) {
  model_.link_poses(q, poses_);
  double energy = 0.0;
  for (std::size_t i = 0; i < inertials_.size(); ++i)
    energy -= inertials_[i].mass * gravity_W.dot(poses_[i] * inertials_[i].com_L);
  return energy;
}

}  // namespace pedicel::robot
