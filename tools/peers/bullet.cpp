// Bullet's btMultiBody: spherical joints, articulated bodies, explicit springs. Its joint
// constraints know no spring law for spherical joints that would be right at this stiffness.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "peer.h"

namespace {

using namespace peers;

btVector3 bt(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

std::unique_ptr<btMultiBody> make_body(const Plant& plant) {
  const int count = static_cast<int>(plant.size());
  auto body = std::make_unique<btMultiBody>(count, 0.0, btVector3(0, 0, 0), true, false);
  body->setBasePos(btVector3(0, 0, 0));
  for (int e = 0; e < count; ++e) {
    const Element& element = plant[e];
    const Eigen::Quaterniond from_parent(element.frame_P.transpose());
    // Bullet's link frames lie in the centre of mass.
    const double parent_half = element.parent < 0 ? 0.0 : 0.5 * plant[element.parent].length;
    body->setupSpherical(
        e, element.mass, bt(element.inertia), element.parent,
        btQuaternion(from_parent.x(), from_parent.y(), from_parent.z(), from_parent.w()),
        bt(element.start_P - parent_half * Vector3d::UnitZ()),
        btVector3(0, 0, 0.5 * element.length), true);
  }
  body->finalizeMultiDof();
  body->setAngularDamping(0.0);
  return body;
}

class BulletWorld : public World {
 public:
  BulletWorld(const std::vector<Plant>& plants, double dt) : dt_(dt), plants_(plants) {
    for (const Plant& plant : plants) {
      bodies_.push_back(make_body(plant));
      world_.addMultiBody(bodies_.back().get());
    }
  }
  ~BulletWorld() override {
    for (const auto& body : bodies_) world_.removeMultiBody(body.get());
  }
  void set_environment(double gravity, double drag) override {
    world_.setGravity(btVector3(0, 0, -gravity));
    for (const auto& body : bodies_) body->setLinearDamping(drag);
  }
  void step() override {
    for (std::size_t p = 0; p < plants_.size(); ++p)
      for (std::size_t e = 0; e < plants_[p].size(); ++e) {
        const btScalar* q = bodies_[p]->getJointPosMultiDof(e);
        const Eigen::AngleAxisd turned(Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
        const Vector3d moment =
            -plants_[p][e].stiffness.cwiseProduct(turned.angle() * turned.axis());
        bodies_[p]->addJointTorqueMultiDof(e, moment.data());
      }
    world_.stepSimulation(dt_, 0);
  }
  Vector3d end(int plant, int element) const override {
    const btVector3 tip = bodies_[plant]->localPosToWorld(
        element, btVector3(0, 0, 0.5 * plants_[plant][element].length));
    return {tip.x(), tip.y(), tip.z()};
  }

 private:
  double dt_;  // s
  std::vector<Plant> plants_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btMultiBody>> bodies_;
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, [](const std::vector<Plant>& plants, double dt) {
    return std::make_unique<BulletWorld>(plants, dt);
  });
}
