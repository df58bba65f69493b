#include "plugins/simulation/giving_robot.h"

namespace pedicel::simulation {

namespace {

// The robot as it stands in the run: what effects change of it is in its description already.
discrepancy::Experiment only_robot(const RobotControl& robot) {
  discrepancy::Experiment experiment;
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
  robot_.robot().place(q_, qd_);
}

void GivingRobot::give_way() {
  q_ = robot_.robot().positions();
  qd_ = robot_.robot().velocities();
  joints_.begin_step(q_);
  arm_.compliance = joints_.compliance();
  const long dofs = q_.size();
  robot_.robot().place(q_ + joints_.deflection(),
                       qd_ + joints_.row().segment(dofs, dofs).transpose());
  arm_.links = robot_.link_poses();
}

void GivingRobot::act(const Eigen::VectorXd& effort) {
  joints_.end_step(effort);
  const long dofs = q_.size();
  const Eigen::VectorXd given = joints_.deflection(),
                        speed = joints_.row().segment(dofs, dofs).transpose();
  robot_.robot().place(q_ + given, qd_ + speed);
  robot_.drives().set_deflection(given);
  for (int i = 0; i < static_cast<int>(dofs); ++i)
    robot_.robot().add_motor_load(i, -(stiffness_ * given[i] + damping_ * speed[i]));
}

}  // namespace pedicel::simulation
