#pragma once

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <memory>
#include <vector>

#include "engine/robot/rigid_groups.h"

namespace pedicel::robot {

/// A compound shape and the shapes that it refers to, which it does not own.
struct GroupShape {
  std::unique_ptr<btCompoundShape> compound;
  std::vector<std::unique_ptr<btCollisionShape>> parts;
};

/// The collision geometry of a group in its principal frame: boxes, cylinders and spheres as they
/// are, meshes as convex hulls. Each part's user index is the link that it belongs to.
GroupShape group_shape(const RobotDescription& robot, const RigidGroup& group, const Pose& X_GC);

}  // namespace pedicel::robot
