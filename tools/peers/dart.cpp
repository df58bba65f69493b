// DART: ball joints, articulated bodies. Its joint springs are linearly implicit: they act on
// q + h v'.
#include <dart/dart.hpp>

#include "peer.h"

namespace {

using namespace peers;
using dart::dynamics::BallJoint;
using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;

Eigen::Isometry3d pose(const Matrix3d& rotation, const Vector3d& position) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = position;
  return pose;
}

dart::dynamics::SkeletonPtr make_skeleton(const Plant& plant, const std::string& name) {
  const auto skeleton = Skeleton::create(name);
  for (const Element& element : plant) {
    const std::string number = std::to_string(skeleton->getNumBodyNodes());
    BallJoint::Properties joint;
    joint.mName = "joint_" + number;
    joint.mT_ParentBodyToJoint = pose(element.frame_P, element.start_P);
    for (int k = 0; k < 3; ++k) joint.mSpringStiffnesses[k] = element.stiffness[k];
    BodyNode::Properties body;
    body.mName = "body_" + number;
    body.mInertia = dart::dynamics::Inertia(element.mass, Vector3d(0, 0, 0.5 * element.length),
                                            Matrix3d(element.inertia.asDiagonal()));
    BodyNode* parent = element.parent < 0 ? nullptr : skeleton->getBodyNode(element.parent);
    skeleton->createJointAndBodyNodePair<BallJoint, BodyNode>(parent, joint, body);
  }
  return skeleton;
}

class DartWorld : public World {
 public:
  DartWorld(const std::vector<Plant>& plants, double dt)
      : plants_(plants), world_(dart::simulation::World::create()) {
    world_->setTimeStep(dt);
    for (std::size_t p = 0; p < plants.size(); ++p)
      world_->addSkeleton(make_skeleton(plants[p], "plant_" + std::to_string(p)));
  }
  void set_environment(double gravity, double drag) override {
    world_->setGravity(Vector3d(0, 0, -gravity));
    drag_ = drag;
  }
  void step() override {
    for (std::size_t p = 0; p < plants_.size(); ++p)
      for (BodyNode* body : world_->getSkeleton(p)->getBodyNodes())
        body->addExtForce(-drag_ * body->getMass() * body->getCOMLinearVelocity(),
                          body->getLocalCOM(), false, true);
    world_->step();
  }
  Vector3d end(int plant, int element) const override {
    return world_->getSkeleton(plant)->getBodyNode(element)->getTransform() *
           Vector3d(0, 0, plants_[plant][element].length);
  }

 private:
  std::vector<Plant> plants_;
  dart::simulation::WorldPtr world_;
  double drag_ = 0.0;  // 1/s
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, [](const std::vector<Plant>& plants, double dt) {
    return std::make_unique<DartWorld>(plants, dt);
  });
}
