#include "engine/robot/collision_shapes.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include "engine/robot/bullet_types.h"

namespace pedicel::robot {

namespace {

/// Bullet's own default of 40 mm would blow a link up to twice its size.
constexpr double hull_margin = 0.0005;  // m

std::unique_ptr<btCollisionShape> convex_hull(const geometry::TriangleMesh& mesh) {
  std::vector<btVector3> points;
  for (const Vec3& vertex : mesh.vertices) points.push_back(to_bullet(vertex));
  btConvexHullComputer hull;
  hull.compute(&points[0][0], sizeof(btVector3), static_cast<int>(points.size()), 0, 0);
  auto shape = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < hull.vertices.size(); ++i) shape->addPoint(hull.vertices[i], false);
  shape->recalcLocalAabb();
  shape->setMargin(hull_margin);
  return shape;
}

std::unique_ptr<btCollisionShape> make_shape(const Geometry& geometry) {
  switch (geometry.kind) {
    case Geometry::Kind::box:
      return std::make_unique<btBoxShape>(to_bullet(Vec3(0.5 * geometry.size)));
    case Geometry::Kind::cylinder:
      return std::make_unique<btCylinderShapeZ>(
          btVector3(geometry.radius, geometry.radius, 0.5 * geometry.length));
    case Geometry::Kind::sphere:
      return std::make_unique<btSphereShape>(geometry.radius);
    case Geometry::Kind::capsule:
      return std::make_unique<btCapsuleShapeZ>(geometry.radius, geometry.length);
    case Geometry::Kind::mesh:
      break;
  }
  return convex_hull(*geometry.mesh);
}

}  // namespace

GroupShape group_shape(const RobotDescription& robot, const RigidGroup& group, const Pose& X_GC) {
  GroupShape shape;
  shape.compound = std::make_unique<btCompoundShape>();
  for (const RigidGroup::Member& member : group.members) {
    for (const Collision& collision : robot.links[member.link].collisions) {
      shape.parts.push_back(make_shape(collision.geometry));
      shape.parts.back()->setUserIndex(member.link);
      const Pose pose = X_GC.inverse() * member.X_GL * collision.X_LC;
      shape.compound->addChildShape(to_bullet(pose), shape.parts.back().get());
    }
  }
  return shape;
}

}  // namespace pedicel::robot
