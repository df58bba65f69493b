#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "engine/world/bodies.h"

namespace pedicel::world {

/// Bullet's shape of a body about its centre of mass, with what Bullet needs to know of it.
struct RigidShape {
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::unique_ptr<btCompoundShape> compound;
  Pose X_BC;                    ///< principal frame (centre of mass) in the body's frame
  Vec3 inertia = Vec3::Zero();  ///< kg m2, principal, zero for a static body
};

/// The mass is spread evenly over the parts' volume.
RigidShape make_rigid_shape(const BodyDescription& body);

}  // namespace pedicel::world
