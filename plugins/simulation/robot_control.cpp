#include "plugins/simulation/robot_control.h"

#include <algorithm>
#include <cmath>

namespace pedicel::simulation {

namespace {

robot::RobotSettings settings_of(const world::SceneRobot& scene, bool moves) {
  robot::RobotSettings settings;
  settings.moves = moves;
  settings.base_pose = scene.base;
  return settings;
}

/// The link that waypoints move: the scene's, else one called "tool", else the last link.
int tool_of(const world::SceneRobot& scene, const robot::RobotDescription& description) {
  const int named = description.link(scene.tool.empty() ? "tool" : scene.tool);
  // A name says more than the order of a file, in which an arm's chain mostly ends with what it
  // holds.
  return named >= 0 ? named : static_cast<int>(description.links.size()) - 1;
}

}  // namespace

Eigen::VectorXd manual_speed(const robot::KinematicModel& model,
                             const robot::RobotDescription& description) {
  Eigen::VectorXd speed = model.velocity_limits();
  for (int i = 0; i < model.dofs(); ++i) {
    const robot::JointType type =
        description.joints[description.joint(model.joint_names()[i])].type;
    // Slow enough to follow by eye, whatever a URDF allows.
    const double own = type == robot::JointType::prismatic ? 0.25 : 1.0;
    speed[i] = speed[i] > 0.0 ? std::min(speed[i], own) : own;
  }
  return speed;
}

RobotControl::RobotControl(const world::SceneRobot& scene,
                           const robot::RobotDescription& description, world::SimWorld& world,
                           bool moves)
    : name_(scene.name),
      mode_(scene.control),
      robot_(description, settings_of(scene, moves), world.bullet()),
      reader_(*this),
      tool_link_(tool_of(scene, description)),
      tool_offset_(scene.tool_offset) {
  q_ = robot_.model().neutral();
  qd_ = Eigen::VectorXd::Zero(q_.size());
  // Joints that the scene leaves out stay where the model is neutral.
  for (const auto& [joint, value] : scene.joints) q_[robot_.model().joint_index(joint)] = value;
  // A start outside the limits would be pushed back by the limits' rows in the first step, with all
  // their force.
  q_ = robot_.model().clamped(q_);
  speed_ = manual_speed(robot_.model(), description);
  if (!scene.gripper.empty()) gripper_ = robot_.model().joint_index(scene.gripper);
  // The scene's limit is set on the motor: with it plants are pressed by the same drive that Bullet
  // moves.
  if (scene.gripper_force > 0.0 && gripper_ >= 0)
    robot_.motors().set_effort_limit(gripper_, scene.gripper_force);
  // At rest in its first pose, before the first step: plants look at the links when contacts are
  // set up.
  robot_.reset(q_, qd_);
  start_of_step_ = q_;
}

void RobotControl::act(world::SimWorld& world, world::WorldReport&) {
  // A grip measures from here how far Bullet has moved it.
  start_of_step_ = robot_.positions();
  // A goal by hand goes before the program. Where neither is there, q_ holds what was told last,
  // and the motors go on to hold it.
  if (readings_)
    readings_(world.time() + world.dt(), q_, qd_);
  else if (goal_)
    approach_goal(world.dt());
  else if (!program_.empty())
    // A target is where the joint shall be at the end of this step.
    program_.sample(world.time() + world.dt(), q_, qd_);
  // The program goes on as it is told: what lags is what the motors get.
  const JointTargets* lagged =
      led_ ? nullptr : drives_.follow(q_, qd_, robot_.positions(), world.dt());
  const Eigen::VectorXd &q = lagged ? lagged->q : q_, &qd = lagged ? lagged->qd : qd_;
  // Led by its motors, nobody but the one who leads sets targets.
  for (int i = 0; i < q_.size() && !led_; ++i) {
    if (mode_ == "position") robot_.motors().set_position_target(i, q[i], qd[i]);
    if (mode_ == "velocity") robot_.motors().set_velocity_target(i, qd_[i]);
    // Without anyone who leads it a robot in torque mode is limp. Set in each step: a torque that
    // was led before would else act on.
    if (mode_ == "torque") robot_.motors().set_torque(i, 0.0);
  }
  // After all targets: it makes the inverse dynamics' torque from them.
  robot_.begin_step(world.dt());
}

void RobotControl::go_to(const Eigen::VectorXd& q) {
  // A program may be ahead of a robot that could not keep up.
  if (follows_program() || led_) q_ = robot_.model().clamped(robot_.positions());
  // A goal by hand ends the program, and only a new one takes over again.
  goal_ = robot_.model().clamped(q);
  // Else the program would go on where it was, as soon as the goal is reached.
  program_ = {};
  led_ = false;
}

void RobotControl::lead_by_motors() {
  goal_.reset();
  program_ = {};
  led_ = true;
}

Eigen::VectorXd RobotControl::goal() const {
  if (goal_) return *goal_;
  if (led_) return robot_.positions();
  if (program_.empty()) return q_;
  Eigen::VectorXd q = q_, qd = qd_;
  // Where it is told to go in the end, not where the program is now: panels show this beside where
  // it is.
  program_.sample_end(q, qd);
  return q;
}

void RobotControl::lead_by_readings(JointReadings readings) {
  readings_ = std::move(readings);
  readings_(0.0, q_, qd_);
  robot_.reset(q_, qd_);
  start_of_step_ = q_;
}

void RobotControl::approach_goal(double dt) {
  for (int i = 0; i < q_.size(); ++i) {
    // Each joint by itself. The speed goes along as the target's rate: position control takes it
    // ahead, and so does not lag behind.
    const double step = std::clamp((*goal_)[i] - q_[i], -speed_[i] * dt, speed_[i] * dt);
    q_[i] += step;
    qd_[i] = step / dt;
  }
}

void RobotControl::Reader::act(world::SimWorld&, world::WorldReport& report) {
  robot::Robot& robot = control_.robot_;
  // Read out as soon as Bullet is done: plants need the links' new poses.
  robot.end_step();
  // Motors get it there but for what pushes at it; what was recorded is where it was.
  if (control_.readings_) robot.place(control_.q_, control_.qd_);
  const Eigen::VectorXd& q = robot.positions();
  // The world stops on this, so the joint is named: a position that is no number spreads to all
  // links in one step.
  if (q.allFinite()) return;
  report.errors |= world::robot_not_finite;
  for (int i = 0; i < q.size() && report.culprit.empty(); ++i)
    if (!std::isfinite(q[i]))
      report.culprit = robot.description().name + "/" + robot.model().joint_names()[i];
  report.cause = "the joint's position is not a finite number";
}

Pose RobotControl::tool_pose() const {
  const Pose link = robot_.link_pose_W(tool_link_);
  return {link * tool_offset_, link.rotation};
}

}  // namespace pedicel::simulation
