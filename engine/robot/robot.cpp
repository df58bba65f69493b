#include "engine/robot/robot.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>

#include "engine/core/check.h"
#include "engine/robot/bullet_types.h"
#include "engine/robot/joint_drive.h"
#include "engine/robot/multibody.h"

namespace pedicel::robot {

std::vector<Parameter> RobotSettings::parameters() {
  return {
      {"contact_friction", "1", &contact_friction, 0.0, 10.0,
       "Coulomb coefficient of the links' surfaces against rigid bodies."},
      {"position_gain", "1", &position_gain, 0.01, 1.0,
       "Share of a joint's position error that its motor removes in one step; 1 is stiffest."},
  };
}

namespace {

const RobotSettings& checked(RobotSettings& settings) {
  if (const auto fault = check_parameters(settings.parameters())) throw UsageError(*fault);
  return settings;
}

}  // namespace

struct Robot::Impl {
  Impl(const RobotDescription& robot, const RobotSettings& wanted, btMultiBodyDynamicsWorld& world)
      : description(robot),
        settings(wanted),
        model(description, checked(settings).base_pose),
        multibody(description, model, settings, world),
        drive(description, model, settings, multibody),
        motors(description, model, drive),
        dynamics(description, model) {
    q.setZero(model.dofs());
    qd = torques = recoil = q;
    forces.reserve(1024);  // a step allocates only beyond this many contacts
  }

  void place_joints(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity);
  void read();
  void add_effort(std::span<const LinkReaction> reactions, Eigen::VectorXd& effort) const;
  const Jacobian& jacobian(int link, const Vec3& point_W) const;

  RobotDescription description;
  RobotSettings settings;
  KinematicModel model;
  MultiBody multibody;
  JointDrive drive;
  JointMotors motors;
  mutable Dynamics dynamics;  // only its work space changes
  mutable Jacobian work_jacobian;
  Eigen::LLT<Eigen::MatrixXd> mass;  // at q
  Eigen::VectorXd recoil;            // rad or m, of the last add_reactions()
  Eigen::VectorXd q, qd, torques;
  std::vector<Pose> poses;
  std::vector<Twist> twists;
  std::vector<LinkForce> forces;
};

void Robot::Impl::place_joints(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity) {
  for (int k = 0; k < multibody.joints(); ++k) {
    const auto& e = model.elements()[multibody.joint_group(k).element];
    multibody.body().setJointPos(k, e.multiplier * position[e.dof] + e.offset);
    multibody.body().setJointVel(k, e.multiplier * velocity[e.dof]);
  }
}

void Robot::Impl::read() {
  for (int k = 0; k < multibody.joints(); ++k) {
    const auto& e = model.elements()[multibody.joint_group(k).element];
    if (description.joints[e.joint].mimic) continue;
    q[e.dof] = multibody.body().getJointPos(k);
    qd[e.dof] = multibody.body().getJointVel(k);
  }
  if (!settings.fixed_base) model.set_base_pose(multibody.base_pose());
  model.link_poses(q, poses);
  model.link_velocities(poses, qd, twists, multibody.base_twist());
}

const Jacobian& Robot::Impl::jacobian(int link, const Vec3& point_W) const {
  model.jacobian(poses, link, poses[link].inverse() * point_W, work_jacobian);
  return work_jacobian;
}

Robot::Robot(const RobotDescription& description, const RobotSettings& settings,
             btMultiBodyDynamicsWorld& world)
    : impl_(std::make_unique<Impl>(description, settings, world)) {
  reset(model().neutral(), Eigen::VectorXd::Zero(model().dofs()));
}

Robot::~Robot() = default;

const RobotDescription& Robot::description() const {
  return impl_->description;
}
const KinematicModel& Robot::model() const {
  return impl_->model;
}
const RobotSettings& Robot::settings() const {
  return impl_->settings;
}
const Eigen::VectorXd& Robot::positions() const {
  return impl_->q;
}
const Eigen::VectorXd& Robot::velocities() const {
  return impl_->qd;
}
const Eigen::VectorXd& Robot::motor_torques() const {
  return impl_->torques;
}
const std::vector<Pose>& Robot::link_poses() const {
  return impl_->poses;
}
const std::vector<Twist>& Robot::link_twists() const {
  return impl_->twists;
}
JointMotors& Robot::motors() {
  return impl_->motors;
}
const JointMotors& Robot::motors() const {
  return impl_->motors;
}
btMultiBody& Robot::multibody() {
  return impl_->multibody.body();
}

double Robot::joint_position(const std::string& joint) const {
  const Impl& robot = *impl_;
  const int index = robot.description.joint(joint);
  for (int k = 0; k < robot.multibody.joints(); ++k)
    if (robot.model.elements()[robot.multibody.joint_group(k).element].joint == index)
      return robot.multibody.body().getJointPos(k);
  throw UsageError("robot '" + robot.description.name + "': no joint '" + joint + "' that moves");
}

int Robot::link(const std::string& name) const {
  const int index = model().link_index(name);
  if (index < 0) throw UsageError("robot '" + description().name + "': no link '" + name + "'");
  return index;
}

void Robot::place_joint(int joint, double position, double velocity) {
  impl_->q[impl_->motors.checked(joint)] = position;
  impl_->qd[joint] = velocity;
  place(impl_->q, impl_->qd);
}

void Robot::place(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  impl_->place_joints(q, qd);
  if (impl_->settings.moves) impl_->multibody.update_colliders();
  impl_->read();
}

void Robot::add_motor_load(int joint, double load) {
  const double effort = motors().effort_limit(joint);
  impl_->torques[joint] = std::clamp(impl_->torques[joint] + load, -effort, effort);
}

void Robot::add_external_force(int link, const Vec3& force_W, const Vec3& point_W) {
  // Kept until begin_step(): Bullet forgets forces that are added from its tick callbacks.
  impl_->forces.push_back({link, force_W, point_W});
}

void Robot::Impl::add_effort(std::span<const LinkReaction> reactions,
                             Eigen::VectorXd& effort) const {
  for (const LinkReaction& reaction : reactions) {
    const Jacobian& j = jacobian(reaction.link, reaction.point_W);
    effort += j.topRows<3>().transpose() * reaction.force_W;
    effort += j.bottomRows<3>().transpose() * reaction.moment_W;
  }
}

Eigen::VectorXd Robot::effort_of(std::span<const LinkReaction> forces) const {
  Eigen::VectorXd effort = Eigen::VectorXd::Zero(model().dofs());
  impl_->add_effort(forces, effort);
  return effort;
}

void Robot::add_reactions(std::span<const LinkReaction> reactions, double dt) {
  Impl& robot = *impl_;
  robot.mass.compute(robot.dynamics.mass_matrix(robot.q));
  robot.recoil.setZero();
  robot.add_effort(reactions, robot.recoil);
  robot.mass.solveInPlace(robot.recoil);
  robot.recoil *= dt * dt;
  robot.drive.expect_recoil(robot.recoil);
  if (reactions.empty()) return;
  place(robot.q + robot.recoil, robot.qd + robot.recoil / dt);
}

double Robot::inverse_inertia(int a, const Vec3& point_a_W, int b, const Vec3& point_b_W) const {
  const Eigen::MatrixXd response =
      impl_->mass.solve(impl_->jacobian(b, point_b_W).topRows<3>().transpose());
  const Mat3 both = impl_->jacobian(a, point_a_W).topRows<3>() * response;
  return both.jacobiSvd().singularValues()[0];
}

void Robot::begin_step(double dt) {
  if (!impl_->settings.moves) return;
  for (const LinkForce& f : impl_->forces) impl_->multibody.add_force(f.link, f.force_W, f.point_W);
  impl_->drive.begin(impl_->motors.commands(), impl_->q, impl_->qd, impl_->forces, dt);
  impl_->forces.clear();
}

void Robot::end_step() {
  if (!impl_->settings.moves) return;
  impl_->read();
  impl_->drive.end(impl_->torques);
}

void Robot::reset(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  if (q.size() != model().dofs() || qd.size() != model().dofs())
    throw UsageError("robot '" + description().name + "': reset expects " +
                     std::to_string(model().dofs()) + " joint values");
  impl_->place_joints(q, qd);
  impl_->multibody.update_colliders();
  impl_->torques.setZero();
  impl_->forces.clear();
  impl_->recoil.setZero();
  impl_->drive.expect_recoil(impl_->recoil);
  impl_->mass.compute(impl_->dynamics.mass_matrix(q));
  for (int i = 0; i < model().dofs(); ++i) motors().set_position_target(i, q[i]);
  impl_->read();
}

RobotState Robot::state() const {
  const btMultiBody& body = impl_->multibody.body();
  RobotState state;
  for (int k = 0; k < impl_->multibody.joints(); ++k) {
    state.joint_positions.push_back(body.getJointPos(k));
    state.joint_velocities.push_back(body.getJointVel(k));
  }
  const btVector3 position = body.getBasePos(), angular = body.getBaseOmega(),
                  linear = body.getBaseVel();
  const btQuaternion& rotation = body.getWorldToBaseRot();
  state.base.assign(&position[0], &position[0] + 3);
  state.base.insert(state.base.end(), &rotation[0], &rotation[0] + 4);
  state.base.insert(state.base.end(), &angular[0], &angular[0] + 3);
  state.base.insert(state.base.end(), &linear[0], &linear[0] + 3);
  return state;
}

void Robot::set_state(const RobotState& state) {
  btMultiBody& body = impl_->multibody.body();
  const auto joints = static_cast<std::size_t>(impl_->multibody.joints());
  if (state.joint_positions.size() != joints || state.joint_velocities.size() != joints ||
      state.base.size() != 13)
    throw UsageError("robot '" + description().name + "': the state of another robot");
  for (int k = 0; k < impl_->multibody.joints(); ++k) {
    body.setJointPos(k, state.joint_positions[k]);
    body.setJointVel(k, state.joint_velocities[k]);
  }
  const std::vector<double>& b = state.base;
  body.setBasePos({b[0], b[1], b[2]});
  body.setWorldToBaseRot({b[3], b[4], b[5], b[6]});
  body.setBaseOmega({b[7], b[8], b[9]});
  body.setBaseVel({b[10], b[11], b[12]});
  impl_->multibody.update_colliders();
  impl_->forces.clear();
  impl_->read();
}

void Robot::add_to(StateHash& hash) const {
  const btMultiBody& body = impl_->multibody.body();
  for (int k = 0; k < impl_->multibody.joints(); ++k) {
    hash.add(body.getJointPos(k));
    hash.add(body.getJointVel(k));
  }
  hash.add(from_bullet(body.getBasePos()));
  hash.add(from_bullet(body.getWorldToBaseRot()));
  hash.add(from_bullet(body.getBaseOmega()));
  hash.add(from_bullet(body.getBaseVel()));
}

double Robot::energy() const {
  const Vec3 gravity = from_bullet(impl_->multibody.world().getGravity());
  return impl_->dynamics.kinetic_energy(impl_->q, impl_->qd) +
         impl_->dynamics.potential_energy(impl_->q, gravity);
}

}  // namespace pedicel::robot
