// Bullet's btSoftBody: ropes of distance constraints, solved position-based. No rod model: what
// resists bending are distances across two elements, which are soft where the rope is straight and
// stiffer with every iteration.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "peer.h"

namespace {

using namespace peers;

btVector3 bt(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// Node 0 is the root, node e + 1 the far end of element e. Both nodes of the first element are
// fixed: that is its clamp.
std::unique_ptr<btSoftBody> make_rope(const Plant& plant, btSoftBodyWorldInfo& info) {
  std::vector<btVector3> nodes = {bt(plant[0].start)};
  std::vector<btScalar> masses = {0.0};
  for (const Element& element : plant) {
    nodes.push_back(bt(element.end()));
    masses[element.parent + 1] += 0.5 * element.mass;
    masses.push_back(0.5 * element.mass);
  }
  auto rope = std::make_unique<btSoftBody>(&info, static_cast<int>(nodes.size()), nodes.data(),
                                           masses.data());
  for (std::size_t e = 0; e < plant.size(); ++e)
    rope->appendLink(plant[e].parent + 1, static_cast<int>(e) + 1);
  rope->setMass(0, 0.0);
  rope->setMass(1, 0.0);
  rope->generateBendingConstraints(2);
  rope->m_materials[0]->m_kLST = 1.0;
  rope->m_cfg.piterations = 10;
  rope->m_cfg.collisions = 0;
  rope->setActivationState(DISABLE_DEACTIVATION);
  return rope;
}

class SoftWorld : public World {
 public:
  SoftWorld(const std::vector<Plant>& plants, double dt) : dt_(dt) {
    for (const Plant& plant : plants) {
      ropes_.push_back(make_rope(plant, world_.getWorldInfo()));
      world_.addSoftBody(ropes_.back().get());
    }
  }
  ~SoftWorld() override {
    for (const auto& rope : ropes_) world_.removeSoftBody(rope.get());
  }
  void set_environment(double gravity, double drag) override {
    world_.setGravity(btVector3(0, 0, -gravity));
    world_.getWorldInfo().m_gravity = btVector3(0, 0, -gravity);
    for (const auto& rope : ropes_) rope->m_cfg.kDP = drag * dt_;  // share of velocity a step
  }
  void step() override { world_.stepSimulation(dt_, 0); }
  Vector3d end(int plant, int element) const override {
    const btVector3& x = ropes_[plant]->m_nodes[element + 1].m_x;
    return {x.x(), x.y(), x.z()};
  }

 private:
  double dt_;  // s
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btSoftBody>> ropes_;
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, [](const std::vector<Plant>& plants, double dt) {
    return std::make_unique<SoftWorld>(plants, dt);
  });
}
