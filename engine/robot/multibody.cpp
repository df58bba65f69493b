#include "engine/robot/multibody.h"

#include "engine/core/check.h"
#include "engine/robot/bullet_types.h"

namespace pedicel::robot {

MultiBody::MultiBody(const RobotDescription& robot, const KinematicModel& model,
                     const RobotSettings& settings, btMultiBodyDynamicsWorld& world)
    : world_(world), groups_(rigid_groups(robot, model)), group_of_(robot.links.size()) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    frames_.push_back(principal_frame(groups_[g].inertial));
    for (const RigidGroup::Member& member : groups_[g].members)
      group_of_[member.link] = static_cast<int>(g);
  }
  if (!settings.fixed_base && groups_[0].inertial.mass <= 0.0)
    throw UsageError("robot '" + robot.name + "': a floating base needs mass");

  body_ =
      std::make_unique<btMultiBody>(static_cast<int>(groups_.size()) - 1, groups_[0].inertial.mass,
                                    to_bullet(frames_[0].inertia), settings.fixed_base, false);
  for (int k = 0; k < static_cast<int>(groups_.size()) - 1; ++k) set_up_joint(robot, model, k);
  body_->finalizeMultiDof();
  body_->setBaseWorldTransform(to_bullet(model.base_pose() * frames_[0].X_GC));
  body_->setLinearDamping(0.0);  // Bullet's defaults brake every link by 4 % a second
  body_->setAngularDamping(0.0);
  body_->setHasSelfCollision(false);
  body_->setCanSleep(false);
  body_->useRK4Integration(settings.rk4);
  if (settings.moves) world_.addMultiBody(body_.get());
  for (std::size_t g = 0; g < groups_.size() && settings.moves; ++g)
    add_collider(robot, settings, static_cast<int>(g));
  update_colliders();
}

MultiBody::~MultiBody() {
  for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
  world_.removeMultiBody(body_.get());
}

void MultiBody::set_up_joint(const RobotDescription& robot, const KinematicModel& model, int k) {
  const RigidGroup& group = groups_[k + 1];
  const PrincipalFrame& parent = frames_[group.parent];
  const PrincipalFrame& own = frames_[k + 1];
  const Pose X_PcC0 = parent.X_GC.inverse() * group.X_PJ * own.X_GC;
  const btQuaternion parent_to_this = to_bullet(X_PcC0.rotation.conjugate());
  const Vec3 pivot = parent.X_GC.inverse() * group.X_PJ.position;
  const Quat to_own = own.X_GC.rotation.conjugate();
  const btVector3 axis = to_bullet(Vec3(to_own * model.elements()[group.element].axis));
  const btVector3 pivot_to_com = to_bullet(Vec3(to_own * own.X_GC.position));
  const double mass = group.inertial.mass;
  PEDICEL_ASSERT(mass > 0.0);  // substitute_inertia() has seen to it
  if (robot.joints[model.elements()[group.element].joint].type == JointType::prismatic)
    body_->setupPrismatic(k, mass, to_bullet(own.inertia), group.parent - 1, parent_to_this, axis,
                          to_bullet(pivot), pivot_to_com, true);
  else
    body_->setupRevolute(k, mass, to_bullet(own.inertia), group.parent - 1, parent_to_this, axis,
                         to_bullet(pivot), pivot_to_com, true);
}

void MultiBody::add_collider(const RobotDescription& robot, const RobotSettings& settings,
                             int group) {
  const int link = group - 1;
  shapes_.push_back(group_shape(robot, groups_[group], frames_[group].X_GC));
  auto collider = std::make_unique<btMultiBodyLinkCollider>(body_.get(), link);
  collider->setCollisionShape(shapes_.back().compound.get());
  collider->setFriction(settings.contact_friction);
  collider->setUserIndex(groups_[group].link);
  collider->setActivationState(DISABLE_DEACTIVATION);
  if (link < 0)
    body_->setBaseCollider(collider.get());
  else
    body_->getLink(link).m_collider = collider.get();

  const bool still = link < 0 && settings.fixed_base;
  if (still) collider->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
  int filter = still ? btBroadphaseProxy::StaticFilter : settings.collision_group;
  int mask = settings.collision_mask;
  if (still) mask &= ~btBroadphaseProxy::StaticFilter;
  // A link without geometry still needs its collider, or Bullet drops its constraints.
  if (!settings.collide || shapes_.back().parts.empty()) mask = 0;
  world_.addCollisionObject(collider.get(), filter, mask);
  colliders_.push_back(std::move(collider));
}

Pose MultiBody::base_pose() const {
  return from_bullet(body_->getBaseWorldTransform()) * frames_[0].X_GC.inverse();
}

Twist MultiBody::base_twist() const {
  if (body_->hasFixedBase()) return {};
  const Vec3 angular = from_bullet(body_->getBaseOmega());
  const Vec3 from_com = base_pose().position - from_bullet(body_->getBasePos());
  return {from_bullet(body_->getBaseVel()) + angular.cross(from_com), angular};
}

void MultiBody::add_force(int link, const Vec3& force_W, const Vec3& point_W) {
  const int index = group_of_[link] - 1;
  const btVector3 com =
      index < 0 ? body_->getBasePos() : body_->getLink(index).m_cachedWorldTransform.getOrigin();
  const Vec3 torque = (point_W - from_bullet(com)).cross(force_W);
  if (index < 0) {
    body_->addBaseForce(to_bullet(force_W));
    body_->addBaseTorque(to_bullet(torque));
  } else {
    body_->addLinkForce(index, to_bullet(force_W));
    body_->addLinkTorque(index, to_bullet(torque));
  }
}

void MultiBody::update_colliders() {
  body_->forwardKinematics(scratch_rotations_, scratch_origins_);
  body_->updateCollisionObjectWorldTransforms(scratch_rotations_, scratch_origins_);
}

}  // namespace pedicel::robot
