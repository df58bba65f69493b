#include "plugins/simulation/giving_robot.h"

#include "plugins/simulation/colliders.h"

namespace pedicel::simulation {

namespace {

// The robot as it stands in the run: what effects change of it is in its description already.
discrepancy::SceneExperiment only_robot(const RobotControl& robot) {
  discrepancy::SceneExperiment experiment;
  experiment.robot = robot.description();
  experiment.scene.robot.emplace();
  experiment.scene.robot->base = robot.robot().model().base_pose();
  return experiment;
}

discrepancy::SceneState only_joints(const discrepancy::SceneState& state) {
  discrepancy::SceneState own;
  own.joint_stiffness = state.joint_stiffness;
  own.joint_damping_time = state.joint_damping_time;
  return own;
}

}  // namespace

GivingRobot::GivingRobot(RobotControl& robot, const discrepancy::SceneState& state, double dt)
    : robot_(robot),
      stiffness_(state.joint_stiffness),
      damping_(state.joint_damping_time * state.joint_stiffness),
      model_(only_robot(robot), only_joints(state)),
      joints_(model_, state, dt),
      q_(robot.robot().positions()),
      qd_(robot.robot().velocities()),
      before_(world::Phase::control, *this, &GivingRobot::go_back),
      after_(world::Phase::plants, *this, &GivingRobot::give_way) {
  arm_.arm = &model_;
  arm_.gives = true;
  arm_.links = robot.link_poses();
  arm_.compliance = joints_.compliance();
}

void GivingRobot::go_back() {
  place(q_, qd_);
}

void GivingRobot::give_way() {
  q_ = robot_.robot().positions();
  qd_ = robot_.robot().velocities();
  joints_.begin_step(q_);
  arm_.compliance = joints_.compliance();
  const long dofs = q_.size();
  place(q_ + joints_.deflection(), qd_ + joints_.row().segment(dofs, dofs).transpose());
  arm_.links = robot_.link_poses();
}

void GivingRobot::act(const coupling::ContactReport& contacts,
                      const coupling::ColliderSet& colliders) {
  const robot::KinematicModel& model = robot_.robot().model();
  Eigen::VectorXd effort = Eigen::VectorXd::Zero(q_.size());
  robot::Jacobian jacobian;
  for (int c = 0; c < colliders.size(); ++c) {
    const coupling::ContactSum& sum = contacts.colliders()[static_cast<std::size_t>(c)];
    const coupling::Collider& collider = colliders.collider(c);
    if (collider.body != robot_body || sum.contacts == 0) continue;
    const Pose& pose = arm_.links[static_cast<std::size_t>(collider.link)];
    model.jacobian(arm_.links, collider.link, pose.inverse() * sum.place_W, jacobian);
    Eigen::Matrix<double, 6, 1> push;
    push << sum.force_W, sum.moment_W;
    effort += jacobian.transpose() * push;
  }
  joints_.end_step(effort);
  const long dofs = q_.size();
  const Eigen::VectorXd given = joints_.deflection(),
                        speed = joints_.row().segment(dofs, dofs).transpose();
  place(q_ + given, qd_ + speed);
  robot_.drives().set_deflection(given);
  for (int i = 0; i < static_cast<int>(dofs); ++i)
    robot_.robot().add_motor_load(i, -(stiffness_ * given[i] + damping_ * speed[i]));
}

void GivingRobot::place(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  for (int i = 0; i < static_cast<int>(q.size()); ++i) robot_.robot().place_joint(i, q[i], qd[i]);
}

}  // namespace pedicel::simulation
