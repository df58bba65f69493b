#include "plugins/simulation/body_contacts.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

namespace pedicel::simulation {

namespace {

Vec3 from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Links that fixed joints hold together are one Bullet link; its parts know whose they are.
int link_of(const btMultiBodyLinkCollider& collider, int part) {
  const btCollisionShape* shape = collider.getCollisionShape();
  if (!shape->isCompound()) return collider.getUserIndex();
  const auto* compound = static_cast<const btCompoundShape*>(shape);
  if (part < 0 || part >= compound->getNumChildShapes()) return collider.getUserIndex();
  return compound->getChildShape(part)->getUserIndex();
}

/// N, on the first of the two bodies: Bullet's impulses of the step are along the normal that
/// points at it, and along two directions across.
Vec3 force_on_first(const btManifoldPoint& point, double dt) {
  return (from_bullet(point.m_normalWorldOnB) * point.getAppliedImpulse() +
          from_bullet(point.m_lateralFrictionDir1) * point.m_appliedImpulseLateral1 +
          from_bullet(point.m_lateralFrictionDir2) * point.m_appliedImpulseLateral2) /
         dt;
}

}  // namespace

void each_body_contact(
    world::SimWorld& world, robot::Robot& robot,
    const std::function<void(int link, const Vec3& force_W, const Vec3& place_W)>& take) {
  btDispatcher* dispatcher = world.bullet().getDispatcher();
  const btMultiBody* own = &robot.multibody();
  for (int i = 0; i < dispatcher->getNumManifolds(); ++i) {
    const btPersistentManifold* manifold = dispatcher->getManifoldByIndexInternal(i);
    const auto* first = btMultiBodyLinkCollider::upcast(manifold->getBody0());
    const auto* second = btMultiBodyLinkCollider::upcast(manifold->getBody1());
    if (first && first->m_multiBody != own) first = nullptr;
    if (second && second->m_multiBody != own) second = nullptr;
    if (!first == !second) continue;  // none of the two is the robot's, or both are
    for (int p = 0; p < manifold->getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold->getContactPoint(p);
      const Vec3 force = force_on_first(point, world.dt());
      if (first)
        take(link_of(*first, point.m_index0), force, from_bullet(point.getPositionWorldOnA()));
      else
        take(link_of(*second, point.m_index1), -force, from_bullet(point.getPositionWorldOnB()));
    }
  }
}

}  // namespace pedicel::simulation
