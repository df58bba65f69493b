#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using testing::parse;
using testing::pendulum_urdf;
using testing::World;

constexpr double dt = 1.0 / 240.0;
constexpr double inertia = 0.51;  // of pendulum_urdf() about its hinge

VectorXd one(double value) {
  return VectorXd::Constant(1, value);
}

/// A pendulum without gravity that spins freely in torque mode.
struct Spinning {
  World world;
  Robot robot;

  Spinning(const std::string& extras, double speed, const std::string& type = "continuous")
      : robot(parse(pendulum_urdf(extras, type)), {}, world.world) {
    world.world.setGravity(btVector3(0, 0, 0));
    robot.reset(one(0.0), one(speed));
    robot.motors().set_torque(0, 0.0);
  }
  double step() {
    world.step(robot, dt);
    return robot.velocities()[0];
  }
};

TEST(RobotJoint, SpinsForEverWithoutDampingAndFriction) {
  Spinning joint("", 2.0);
  for (int i = 0; i < 1000; ++i) joint.step();
  EXPECT_NEAR(joint.robot.velocities()[0], 2.0, 1e-9);
}

// Implicit Euler on I w' = -d w: each step divides the speed by 1 + d dt / I, however large d is.
TEST(RobotJoint, DampingIsImplicit) {
  for (double damping : {0.1, 1.0, 1000.0}) {
    Spinning joint("<dynamics damping='" + std::to_string(damping) + "'/>", 2.0);
    double expected = 2.0;
    for (int i = 0; i < 100; ++i) {
      expected /= 1.0 + damping * dt / inertia;
      EXPECT_NEAR(joint.step(), expected, 1e-9) << damping;
    }
  }
}

// Coulomb friction takes F dt / I off the speed each step, then holds the joint.
TEST(RobotJoint, FrictionSlowsEvenlyAndThenHolds) {
  Spinning joint("<dynamics friction='0.9'/>", 0.5);
  double expected = 0.5;
  for (int i = 0; i < 100; ++i) {
    expected = std::max(0.0, expected - 0.9 * dt / inertia);
    EXPECT_NEAR(joint.step(), expected, 1e-9);
  }
}

TEST(RobotJoint, StaticFrictionHoldsUpToItsBound) {
  Spinning joint("<dynamics friction='0.9'/>", 0.0);
  joint.robot.motors().set_torque(0, 0.89);
  for (int i = 0; i < 100; ++i) joint.step();
  EXPECT_NEAR(joint.robot.velocities()[0], 0.0, 1e-9);
  joint.robot.motors().set_torque(0, 1.41);  // 0.51 N m beyond friction: 1 rad/s2
  EXPECT_NEAR(joint.step(), dt, 1e-9);
}

TEST(RobotJoint, StopsAtItsLimitWithoutPassingIt) {
  Spinning joint("<limit lower='-0.2' upper='0.5' effort='100' velocity='50'/>", 8.0, "revolute");
  double furthest = 0.0;
  for (int i = 0; i < 240; ++i) {
    joint.step();
    furthest = std::max(furthest, joint.robot.positions()[0]);
  }
  EXPECT_NEAR(furthest, 0.5, 1e-9);
  EXPECT_NEAR(joint.robot.velocities()[0], 0.0, 1e-9);
  joint.robot.motors().set_torque(0, -20.0);  // pressed against the other one
  for (int i = 0; i < 240; ++i) joint.step();
  EXPECT_NEAR(joint.robot.positions()[0], -0.2, 1e-6);
}

/// Two hinges side by side, one the mimic of the other; gravity pulls at both.
const std::string geared =
    "<robot name='r'><link name='base'/><link name='a'>" +
    testing::inertial(1.0, "0.1 0 0", "0.01", "0.01", "0.01") + "</link><link name='b'>" +
    testing::inertial(0.5, "0.1 0 0", "0.01", "0.01", "0.01") +
    "</link><joint name='ja' type='continuous'><parent link='base'/><child link='a'/>"
    "<axis xyz='0 1 0'/><dynamics friction='0.01'/></joint>"
    "<joint name='jb' type='continuous'><parent link='base'/><child link='b'/><origin xyz='0 1 0'/>"
    "<axis xyz='0 1 0'/><mimic joint='ja' multiplier='-2' offset='0.3'/></joint></robot>";

TEST(RobotJoint, AMimicFollowsItsSourceInEveryMode) {
  World world;
  Robot robot(parse(geared), {}, world.world);
  EXPECT_EQ(robot.model().dofs(), 1);
  const auto gap = [&] {
    return std::abs(robot.joint_position("jb") - (0.3 - 2.0 * robot.joint_position("ja")));
  };
  EXPECT_EQ(gap(), 0.0);
  double worst = 0.0;
  for (int step = 1; step <= 720; ++step) {
    if (step < 240)
      robot.motors().set_position_target(0, 0.5 * step * dt, 0.5);
    else if (step < 480)
      robot.motors().set_velocity_target(0, -0.4);
    else
      robot.motors().set_torque(0, 0.2);
    world.step(robot, dt);
    worst = std::max(worst, gap());
  }
  EXPECT_LT(worst, 1e-6);
}

// The source's motor bears both links: m g r cos(q) each, the mimic's times its multiplier.
TEST(RobotJoint, TheSourcesMotorBearsTheMimicsLoad) {
  World world;
  Robot robot(parse(geared), {}, world.world);
  robot.reset(one(0.2), one(0.0));
  for (int step = 0; step < 480; ++step) world.step(robot, dt);
  const double a = 1.0 * 9.81 * 0.1 * std::cos(0.2), b = 0.5 * 9.81 * 0.1 * std::cos(0.3 - 0.4);
  EXPECT_NEAR(robot.motor_torques()[0], -a + 2.0 * b, 1e-6);
}

TEST(RobotJoint, FingersOfTheGripperKeepTogetherUnderAForceOnOne) {
  World world;
  Robot robot(load_urdf(testing::asset("gantry_gripper")), {}, world.world);
  const int joint = robot.model().joint_index("finger_joint");
  const int finger = robot.model().link_index("left_finger");
  robot.motors().set_position_target(joint, 0.02);
  for (int step = 0; step < 240; ++step) {
    const Pose& pose = robot.link_pose_W(finger);
    robot.add_external_force(finger, pose.rotation * Vec3(0, -5, 0), pose * Vec3(0, 0, 0.12));
    world.step(robot, dt);
  }
  EXPECT_NEAR(robot.joint_position("finger_joint"), 0.02, 1e-4);
  EXPECT_NEAR(robot.joint_position("finger_joint_mirror"), 0.02, 1e-4);
}

}  // namespace
}  // namespace pedicel::robot
