#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using testing::World;

constexpr double dt = 1.0 / 240.0;

/// A level paddle of 0.4 m on a hinge at its end, 0.02 m thick, 1 kg.
const std::string paddle =
    "<robot name='paddle'><link name='base'/><link name='blade'>" +
    testing::inertial(1.0, "0.2 0 0", "0.01", "0.01", "0.01") +
    "<collision><origin xyz='0.2 0 0'/><geometry><box size='0.4 0.4 0.02'/></geometry></collision>"
    "</link><joint name='hinge' type='continuous'><parent link='base'/><child link='blade'/>"
    "<axis xyz='0 1 0'/></joint></robot>";

struct Ball {
  btSphereShape shape{0.05};
  btRigidBody body{2.0, nullptr, &shape, btVector3(0.002, 0.002, 0.002)};
};

// The ball comes to rest on the paddle, and the motor then bears its weight: 2 kg g at 0.3 m beside
// 1 kg g at 0.2 m.
TEST(RobotContact, ARigidBodyRestsOnALinkAndTheMotorFeelsIt) {
  World world;
  world.world.getSolverInfo().m_numIterations = 50;
  Robot robot(testing::parse(paddle), {}, world.world);
  Ball ball;
  ball.body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0.3, 0, 0.08)));
  world.world.addRigidBody(&ball.body);
  double sum = 0.0;
  for (int step = 0; step < 720; ++step) {
    world.step(robot, dt);
    if (step >= 480) sum += robot.motor_torques()[0] / 240.0;
  }
  EXPECT_NEAR(ball.body.getWorldTransform().getOrigin().z(), 0.06, 2e-3);
  EXPECT_NEAR(sum, -(2.0 * 9.81 * 0.3 + 1.0 * 9.81 * 0.2), 0.02);
  world.world.removeRigidBody(&ball.body);
}

TEST(RobotContact, FallsThroughWhereCollisionsAreOff) {
  World world;
  RobotSettings settings;
  settings.collide = false;
  Robot robot(testing::parse(paddle), settings, world.world);
  Ball ball;
  ball.body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0.3, 0, 0.08)));
  world.world.addRigidBody(&ball.body);
  for (int step = 0; step < 240; ++step) world.step(robot, dt);
  EXPECT_LT(ball.body.getWorldTransform().getOrigin().z(), -1.0);
  world.world.removeRigidBody(&ball.body);
}

// The arm's links overlap at their joints; nothing may push them apart.
TEST(RobotContact, LinksOfOneRobotDoNotTouchEachOther) {
  World world;
  Robot robot(load_urdf(testing::asset("stalk6")), {}, world.world);
  world.step(robot, dt);
  EXPECT_EQ(world.dispatcher.getNumManifolds(), 0);
}

}  // namespace
}  // namespace pedicel::robot
