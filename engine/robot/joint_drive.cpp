#include "engine/robot/joint_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/robot/bullet_types.h"

namespace pedicel::robot {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A motor that would move slower than this (rad/s or m/s) is told to rest: friction would make it
/// creep for ever after the last nanometre, and the sign of rounding would decide its torque.
constexpr double resting_speed = 1e-6;

double sign(double value) {
  return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0;
}

/// Limits nearer than what a joint covers in one step at this speed (rad/s or m/s) are watched.
constexpr double watched_speed = 50.0;

}  // namespace

JointDrive::JointDrive(const RobotDescription& robot, const KinematicModel& model,
                       const RobotSettings& settings, MultiBody& multibody)
    : model_(model), settings_(settings), multibody_(multibody), dynamics_(robot, model) {
  if (multibody.joints() > 0 && settings.moves) {  // Bullet keeps no constraint without links
    rows_ = std::make_unique<JointRows>(&multibody.body(), lay_out(robot, model));
    multibody_.world().addMultiBodyConstraint(rows_.get());
  }
  effort_ = model.effort_limits();
  velocity_.setZero(model.dofs());
  acceleration_ = wanted_ = forward_ = recoil_ = velocity_;
}

JointDrive::~JointDrive() {
  if (rows_ != nullptr) multibody_.world().removeMultiBodyConstraint(rows_.get());
}

std::vector<JointRows::Row> JointDrive::lay_out(const RobotDescription& robot,
                                                const KinematicModel& model) {
  source_.resize(model.dofs());
  for (int k = 0; k < multibody_.joints(); ++k) {
    Drive drive;
    drive.element = multibody_.joint_group(k).element;
    const KinematicModel::Element& element = model.elements()[drive.element];
    drive.joint = &robot.joints[element.joint];
    drive.dof = element.dof;
    drive.multiplier = element.multiplier;
    drive.offset = element.offset;
    if (!drive.joint->mimic) source_[drive.dof] = k;
    drives_.push_back(drive);
  }
  std::vector<JointRows::Row> rows;
  const auto add_row = [&](int link) {
    JointRows::Row row;
    row.link = link;
    rows.push_back(row);
    return static_cast<int>(rows.size()) - 1;
  };
  for (int k = 0; k < multibody_.joints(); ++k) {
    Drive& drive = drives_[k];
    const Joint& joint = *drive.joint;
    drive.motor = add_row(k);
    if (joint.mimic) {
      rows.back().link_b = source_[drive.dof];
      rows.back().coefficient_b = -drive.multiplier;
    }
    if (joint.damping > 0.0) drive.damping = add_row(k);
    if (joint.friction > 0.0) drive.friction = add_row(k);
    if (std::isfinite(joint.lower) || std::isfinite(joint.upper)) drive.limit = add_row(k);
  }
  return rows;
}

double JointDrive::planned_velocity(const JointCommand& command, int dof, double q) const {
  double velocity = command.velocity;
  if (command.mode == ControlMode::position) {
    const double error = command.position - velocity * dt_ - q;
    velocity += settings_.position_gain * error / dt_;
  }
  const double limit = model_.velocity_limits()[dof];
  velocity = std::clamp(velocity, -limit, limit);
  // A motor that pushes against its stop would fight the limit's row to no end.
  velocity = std::min(velocity, std::max(0.0, (model_.upper()[dof] - q) / dt_));
  velocity = std::max(velocity, std::min(0.0, (model_.lower()[dof] - q) / dt_));
  return std::abs(velocity) < resting_speed ? 0.0 : velocity;
}

void JointDrive::plan(const std::vector<JointCommand>& commands, const Eigen::VectorXd& q,
                      const Eigen::VectorXd& qd, std::span<const LinkForce> forces) {
  for (int i = 0; i < model_.dofs(); ++i) {
    const bool free = commands[i].mode == ControlMode::torque;
    const double end = free ? qd[i] : planned_velocity(commands[i], i, q[i]);
    velocity_[i] = end - recoil_[i] / dt_;
    acceleration_[i] = free ? 0.0 : (velocity_[i] - qd[i]) / dt_;
  }
  if (settings_.fixed_base)
    wanted_ = dynamics_.inverse(q, qd, acceleration_, from_bullet(multibody_.world().getGravity()),
                                forces);
  for (Drive& drive : drives_) {
    drive.velocity = drive.multiplier * velocity_[drive.dof];
    const double end = drive.velocity + drive.multiplier * recoil_[drive.dof] / dt_;
    drive.passive = drive.joint->damping * end + drive.joint->friction * sign(end);
    wanted_[drive.dof] += drive.multiplier * drive.passive;
  }
  for (int i = 0; i < model_.dofs(); ++i) {
    const double effort = effort_[i];
    const bool free = commands[i].mode == ControlMode::torque;
    forward_[i] = std::clamp(free ? commands[i].torque : wanted_[i], -effort, effort);
  }
}

void JointDrive::drive_source(int k, const JointCommand& command) {
  const Drive& drive = drives_[k];
  multibody_.body().addJointTorque(k, forward_[drive.dof] - drive.passive);
  JointRows::Row& motor = rows_->row(drive.motor);
  motor.active = command.mode != ControlMode::torque;
  motor.target = drive.velocity;
  const double effort = effort_[drive.dof];
  motor.lower = (-effort - forward_[drive.dof]) * dt_;
  motor.upper = (effort - forward_[drive.dof]) * dt_;
}

void JointDrive::drive_mimic(int k, const JointCommand& command) {
  const Drive& drive = drives_[k];
  const int source = source_[drive.dof];
  btMultiBody& body = multibody_.body();
  double through = 0.0;  // what the transmission hands on, ahead of its row
  if (command.mode != ControlMode::torque) {
    const double dynamic = settings_.fixed_base ? dynamics_.element_torques()[drive.element] : 0.0;
    through = dynamic + drive.passive;
  }
  body.addJointTorque(k, through - drive.passive);
  body.addJointTorque(source, -drive.multiplier * through);
  JointRows::Row& row = rows_->row(drive.motor);
  const double error =
      body.getJointPos(k) - drive.multiplier * body.getJointPos(source) - drive.offset;
  row.active = true;
  row.target = -settings_.position_gain * error / dt_;
  row.lower = -infinity;
  row.upper = infinity;
}

void JointDrive::set_passive_rows(const Drive& drive) {
  // Both were applied ahead for the planned velocity; their rows take care of the rest, so that a
  // joint that moves otherwise is braked as it really moves (README, "Control").
  if (drive.damping >= 0) {
    JointRows::Row& row = rows_->row(drive.damping);
    row.active = true;
    row.target = drive.velocity;
    row.lower = -infinity;
    row.upper = infinity;
    row.softness = 1.0 / (drive.joint->damping * dt_);
  }
  if (drive.friction >= 0) {
    JointRows::Row& row = rows_->row(drive.friction);
    const double recoil = drive.multiplier * recoil_[drive.dof] / dt_;
    const double friction = drive.joint->friction * dt_;
    const double ahead = sign(drive.velocity + recoil) * friction;
    row.active = true;
    row.target = -recoil;  // at rest at the step's very end
    row.lower = ahead - friction;
    row.upper = ahead + friction;
  }
}

void JointDrive::set_limit_row(int k) {
  const Drive& drive = drives_[k];
  if (drive.limit < 0) return;
  JointRows::Row& row = rows_->row(drive.limit);
  const double q = multibody_.body().getJointPos(k);
  const double below = q - drive.joint->lower, above = drive.joint->upper - q;
  const bool low = below < above;
  const double room = low ? below : above;
  // The row keeps the joint from passing the stop within this step; one that is already past it
  // comes back gently.
  const double speed = (room >= 0.0 ? 1.0 : settings_.position_gain) * room / dt_;
  row.active = room < watched_speed * dt_;
  row.target = low ? -speed : speed;
  row.lower = low ? 0.0 : -infinity;
  row.upper = low ? infinity : 0.0;
}

void JointDrive::begin(const std::vector<JointCommand>& commands, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& qd, std::span<const LinkForce> forces, double dt) {
  dt_ = dt;
  wanted_.setZero();
  plan(commands, q, qd, forces);
  for (int k = 0; k < multibody_.joints(); ++k) {
    const Drive& drive = drives_[k];
    if (drive.joint->mimic)
      drive_mimic(k, commands[drive.dof]);
    else
      drive_source(k, commands[drive.dof]);
    set_passive_rows(drive);
    set_limit_row(k);
  }
}

void JointDrive::end(Eigen::VectorXd& torques) const {
  for (int i = 0; i < model_.dofs(); ++i)
    torques[i] = dt_ > 0.0 ? forward_[i] + rows_->impulse(drives_[source_[i]].motor) / dt_ : 0.0;
}

}  // namespace pedicel::robot
