#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>
#include <vector>

#include "engine/robot/collision_shapes.h"
#include "engine/robot/robot.h"

namespace pedicel::robot {

/// The Bullet body of a robot with its colliders, in a world for as long as this object lives.
class MultiBody {
 public:
  MultiBody(const RobotDescription& robot, const KinematicModel& model,
            const RobotSettings& settings, btMultiBodyDynamicsWorld& world);
  ~MultiBody();
  MultiBody(const MultiBody&) = delete;
  MultiBody& operator=(const MultiBody&) = delete;

  btMultiBody& body() { return *body_; }
  const btMultiBody& body() const { return *body_; }
  btMultiBodyDynamicsWorld& world() const { return world_; }

  /// Number of joints that Bullet moves; joint k carries group k + 1.
  int joints() const { return body_->getNumLinks(); }
  const RigidGroup& joint_group(int k) const { return groups_[k + 1]; }

  Pose base_pose() const;  ///< of the root link
  Twist base_twist() const;
  void add_force(int link, const Vec3& force_W, const Vec3& point_W);
  /// Brings colliders and Bullet's caches to the joints' present positions.
  void update_colliders();

 private:
  void set_up_joint(const RobotDescription& robot, const KinematicModel& model, int k);
  void add_collider(const RobotDescription& robot, const RobotSettings& settings, int group);

  btMultiBodyDynamicsWorld& world_;
  std::vector<RigidGroup> groups_;
  std::vector<PrincipalFrame> frames_;  // of each group
  std::vector<int> group_of_;           // link to group
  std::unique_ptr<btMultiBody> body_;
  std::vector<GroupShape> shapes_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  btAlignedObjectArray<btQuaternion> scratch_rotations_;
  btAlignedObjectArray<btVector3> scratch_origins_;
};

}  // namespace pedicel::robot
