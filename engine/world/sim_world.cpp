#include "engine/world/sim_world.h"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <LinearMath/btTransformUtil.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "engine/core/check.h"
#include "engine/core/timer.h"
#include "engine/robot/bullet_types.h"
#include "engine/world/rigid_shape.h"

namespace pedicel::world {

using robot::from_bullet;
using robot::to_bullet;

struct SimWorld::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<btStaticPlaneShape> ground_shape;
  std::unique_ptr<btRigidBody> ground;
};

struct SimWorld::Body {
  BodyDescription description;
  RigidShape shape;
  std::unique_ptr<btRigidBody> bullet;
};

std::vector<Parameter> parameters_of(WorldSettings& s) {
  return {
      {"dt", "s", &s.dt, 1.0e-7, 1.0, "Length of every step; 1/240 s or shorter holds a grip."},
      {"gravity_x", "m/s2", &s.gravity.x(), -100.0, 100.0, "Gravity along X."},
      {"gravity_y", "m/s2", &s.gravity.y(), -100.0, 100.0, "Gravity along Y."},
      {"gravity_z", "m/s2", &s.gravity.z(), -100.0, 100.0, "Gravity along Z, up."},
      {"solver_iterations", "1", &s.solver_iterations, 1, 10000,
       "Iterations of Bullet's contact and motor solver; more hold heavier things in a grip."},
  };
}

SimWorld::SimWorld(const WorldSettings& settings) : settings_(settings) {
  if (const auto refused = check_parameters(parameters_of(settings_)))
    throw UsageError("WorldSettings." + *refused);
  bullet_ = std::make_unique<Bullet>();
  btMultiBodyDynamicsWorld& world = bullet_->world;
  world.setGravity(to_bullet(settings_.gravity));
  world.getSolverInfo().m_numIterations = settings_.solver_iterations;
  // Bodies that overlap are moved apart without giving them the speed of it. Bullet does so beyond
  // 40 mm only, and a fruit without any restitution would come back to 17 mm from half a metre.
  world.getSolverInfo().m_splitImpulsePenetrationThreshold = 0.0;
  world.getDispatchInfo().m_deterministicOverlappingPairs = true;
  world.setInternalTickCallback(
      [](btDynamicsWorld* ticking, btScalar) {
        static_cast<SimWorld*>(ticking->getWorldUserInfo())->run(Phase::plants);
      },
      this);
}

SimWorld::~SimWorld() {
  for (const auto& body : bodies_) bullet_->world.removeRigidBody(body->bullet.get());
  if (bullet_->ground) bullet_->world.removeRigidBody(bullet_->ground.get());
}

void SimWorld::add(Participant& participant) {
  const Phase phase = participant.phase();
  if (phase != Phase::commands && phase != Phase::control && phase != Phase::plants)
    throw UsageError("Participant.phase = " + std::string(name_of(phase)) +
                     ": must be commands, control or plants");
  participants_.push_back(&participant);
}

void SimWorld::add(Observer& observer) {
  observers_.push_back(&observer);
}

void SimWorld::run(Phase phase) {
  const Timer timer;
  for (Participant* participant : participants_)
    if (participant->phase() == phase) participant->act(*this, report_);
  report_.seconds[static_cast<int>(phase)] = timer.seconds();
}

const WorldReport& SimWorld::step() {
  report_.errors = no_error;
  report_.culprit.clear();
  report_.cause.clear();
  report_.worst_residual = report_.deepest_overlap = report_.plant_energy = 0.0;
  report_.contacts = 0;
  report_.seconds.fill(0.0);
  run(Phase::commands);
  run(Phase::control);

  // One step of exactly dt; the plants move from its tick callback, once everything rigid has
  // moved.
  Timer timer;
  bullet_->world.stepSimulation(settings_.dt, 0);
  report_.seconds[static_cast<int>(Phase::bullet)] =
      timer.seconds() - report_.seconds_of(Phase::plants);
  ++steps_;
  report_.time = time();
  check_bodies();

  timer.restart();
  for (Observer* observer : observers_) observer->observe(*this, report_);
  report_.seconds[static_cast<int>(Phase::observe)] = timer.seconds();
  timer.restart();
  if (recorder_) recorder_->observe(*this, report_);
  report_.seconds[static_cast<int>(Phase::record)] = timer.seconds();
  return report_;
}

void SimWorld::check_bodies() {
  for (const auto& body : bodies_) {
    const Vec3 place = from_bullet(body->bullet->getWorldTransform().getOrigin());
    if (place.allFinite()) continue;
    report_.errors |= body_not_finite;
    report_.culprit = body->description.name;
    report_.cause = "its position is not a finite number";
    return;
  }
}

namespace {

void check_body(const BodyDescription& body) {
  if (body.parts.empty()) throw UsageError("body " + body.name + ": has no parts");
  const auto [lower, upper] = bounds_of(body);
  if (!((upper - lower).minCoeff() > 0.0)) throw UsageError("body " + body.name + ": has no size");
}

std::unique_ptr<btRigidBody> make_rigid_body(const BodyDescription& body, const RigidShape& shape) {
  btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, shape.compound.get(),
                                                to_bullet(shape.inertia));
  info.m_startWorldTransform = to_bullet(body.pose * shape.X_BC);
  info.m_friction = body.friction;
  info.m_restitution = body.restitution;
  auto rigid = std::make_unique<btRigidBody>(info);
  rigid->setActivationState(DISABLE_DEACTIVATION);
  if (body.mass == 0.0) return rigid;

  const Vec3 lever = body.pose.rotation * shape.X_BC.position;
  rigid->setLinearVelocity(to_bullet(body.velocity + body.angular_velocity.cross(lever)));
  rigid->setAngularVelocity(to_bullet(body.angular_velocity));
  const auto [lower, upper] = bounds_of(body);
  const double smallest = (upper - lower).minCoeff();
  // Fruits are no perfect spheres: without some rolling resistance (a lever arm, m) they would roll
  // for ever.
  rigid->setRollingFriction(0.01 * smallest);
  rigid->setSpinningFriction(0.01 * smallest);
  // A small fruit in free fall must not pass through a thin tray between two steps.
  rigid->setCcdMotionThreshold(0.25 * smallest);
  rigid->setCcdSweptSphereRadius(0.25 * smallest);
  return rigid;
}

}  // namespace

int SimWorld::add_body(const BodyDescription& description) {
  check_body(description);
  if (body_index(description.name) >= 0)
    throw UsageError("body " + description.name + ": this name is taken");
  auto body = std::make_unique<Body>();
  body->description = description;
  body->shape = make_rigid_shape(description);
  body->bullet = make_rigid_body(description, body->shape);
  bullet_->world.addRigidBody(body->bullet.get());
  bodies_.push_back(std::move(body));
  return body_count() - 1;
}

void SimWorld::set_ground(const GroundPlane& ground) {
  if (bullet_->ground) throw UsageError("ground: there is one already");
  bullet_->ground_shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), ground.height);
  btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, bullet_->ground_shape.get());
  info.m_friction = ground.friction;
  info.m_restitution = ground.restitution;
  bullet_->ground = std::make_unique<btRigidBody>(info);
  // What comes near a plane is braked before it touches, as far as it would else sink in within the
  // step: what is to bounce must lose nothing there.
  if (ground.restitution > 0.0) bullet_->ground->setContactProcessingThreshold(0.0);
  bullet_->world.addRigidBody(bullet_->ground.get());
}

int SimWorld::body_index(std::string_view name) const {
  for (int i = 0; i < body_count(); ++i)
    if (bodies_[i]->description.name == name) return i;
  return -1;
}

const BodyDescription& SimWorld::body(int index) const {
  return bodies_[index]->description;
}

Pose SimWorld::body_pose(int index) const {
  const Body& body = *bodies_[index];
  return from_bullet(body.bullet->getWorldTransform()) * body.shape.X_BC.inverse();
}

Vec3 SimWorld::body_velocity(int index) const {
  return from_bullet(bodies_[index]->bullet->getLinearVelocity());
}

Vec3 SimWorld::body_angular_velocity(int index) const {
  return from_bullet(bodies_[index]->bullet->getAngularVelocity());
}

void SimWorld::push_body(int index, const Vec3& force_W, const Vec3& point_W) {
  btRigidBody& body = *bodies_[index]->bullet;
  const btVector3 lever = to_bullet(point_W) - body.getWorldTransform().getOrigin();
  body.applyForce(to_bullet(force_W), lever);
}

void SimWorld::add_body_reaction(int index, const Vec3& force_W, const Vec3& point_W,
                                 const Vec3& moment_W) {
  btRigidBody& body = *bodies_[index]->bullet;
  if (body.getInvMass() == 0.0) return;
  const btVector3 lever = to_bullet(point_W) - body.getWorldTransform().getOrigin();
  const btVector3 linear = to_bullet(dt() * force_W) * body.getInvMass();
  const btVector3 angular = body.getInvInertiaTensorWorld() *
                            (lever.cross(to_bullet(dt() * force_W)) + to_bullet(dt() * moment_W));
  btTransform moved;
  btTransformUtil::integrateTransform(body.getWorldTransform(), linear, angular, dt(), moved);
  body.setLinearVelocity(body.getLinearVelocity() + linear);
  body.setAngularVelocity(body.getAngularVelocity() + angular);
  body.setCenterOfMassTransform(moved);
}

double SimWorld::body_inverse_inertia(int index, const Vec3& point_W) const {
  const btRigidBody& body = *bodies_[index]->bullet;
  const Vec3 lever = point_W - from_bullet(body.getWorldTransform().getOrigin());
  return body.getInvMass() +
         lever.squaredNorm() * from_bullet(body.getInvInertiaDiagLocal()).maxCoeff();
}

btMultiBodyDynamicsWorld& SimWorld::bullet() {
  return bullet_->world;
}

void SimWorld::add_to(StateHash& hash) const {
  hash.add(static_cast<std::uint64_t>(steps_));
  for (int i = 0; i < body_count(); ++i) {
    const Pose pose = body_pose(i);
    hash.add(pose.position);
    hash.add(pose.rotation);
    hash.add(body_velocity(i));
    hash.add(body_angular_velocity(i));
  }
}

}  // namespace pedicel::world
