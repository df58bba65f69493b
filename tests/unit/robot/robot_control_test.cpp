#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/robot/dynamics.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using testing::parse;
using testing::pendulum_urdf;
using testing::World;

constexpr double dt = 1.0 / 240.0;

// Slow sines on all joints of the arm, under gravity, with its friction and damping.
TEST(RobotControl, PositionModeTracksWithinATenthOfAMilliradian) {
  World world;
  Robot robot(load_urdf(testing::asset("stalk6")), {}, world.world);
  VectorXd start = robot.model().neutral();
  start[2] = 1.2;
  robot.reset(start, VectorXd::Zero(7));
  double worst = 0.0;
  for (int step = 1; step <= 720; ++step) {
    const double t = step * dt;
    VectorXd q = start, qd = VectorXd::Zero(7);
    for (int i = 0; i < 6; ++i) {
      q[i] += 0.15 * (1.0 - std::cos(1.5 * t));
      qd[i] = 0.225 * std::sin(1.5 * t);
    }
    robot.motors().set_position_targets(q, qd);
    world.step(robot, dt);
    worst = std::max(worst, (robot.positions() - q).head<6>().cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-4);
}

TEST(RobotControl, AStepOfTheTargetIsReachedAtNoMoreThanTheJointsSpeed) {
  World world;
  Robot robot(load_urdf(testing::asset("stalk6")), {}, world.world);
  VectorXd target = robot.model().neutral();
  target[0] = 1.0;
  robot.motors().set_position_target(0, 1.0);
  double fastest = 0.0;
  for (int step = 0; step < 240; ++step) {
    world.step(robot, dt);
    fastest = std::max(fastest, std::abs(robot.velocities()[0]));
  }
  EXPECT_NEAR(fastest, 3.14, 1e-3);
  EXPECT_NEAR((robot.positions() - target).cwiseAbs().maxCoeff(), 0.0, 1e-6);
}

TEST(RobotControl, VelocityModeRunsAtTheTargetAndStopsAtTheLimit) {
  World world;
  Robot robot(parse(pendulum_urdf("<limit lower='-1' upper='0.5' effort='1000' velocity='2'/>",
                                  "revolute")),
              {}, world.world);
  robot.motors().set_velocity_target(0, 0.7);
  EXPECT_EQ(robot.motors().mode(0), ControlMode::velocity);
  for (int step = 0; step < 60; ++step) world.step(robot, dt);
  EXPECT_NEAR(robot.velocities()[0], 0.7, 1e-9);
  EXPECT_NEAR(robot.positions()[0], 0.7 * 60 * dt, 1e-9);
  robot.motors().set_velocity_target(0, 50.0);  // faster than the joint may
  world.step(robot, dt);
  EXPECT_NEAR(robot.velocities()[0], 2.0, 1e-9);
  for (int step = 0; step < 120; ++step) world.step(robot, dt);
  EXPECT_NEAR(robot.positions()[0], 0.5, 1e-9);
  EXPECT_NEAR(robot.velocities()[0], 0.0, 1e-9);
}

// At 0.3 rad the pendulum needs m g l sin(0.3) = 2 9.81 0.5 sin(0.3) N m against gravity.
TEST(RobotControl, TorqueModeHoldsAgainstGravity) {
  World world;
  Robot robot(parse(pendulum_urdf("")), {}, world.world);
  robot.reset(VectorXd::Constant(1, 0.3), VectorXd::Zero(1));
  const double hold = 9.81 * std::sin(0.3);
  robot.motors().set_torque(0, hold);
  for (int step = 0; step < 240; ++step) world.step(robot, dt);
  EXPECT_NEAR(robot.positions()[0], 0.3, 1e-9);
  EXPECT_NEAR(robot.motor_torques()[0], hold, 1e-12);
  robot.motors().set_torque(0, hold + 0.51);  // 1 rad/s2 with the inertia of 0.51 kg m2
  world.step(robot, dt);
  EXPECT_NEAR(robot.velocities()[0], dt, 1e-9);
}

// 5 N m hold the pendulum at asin(5 / 9.81), whatever the target beyond it.
TEST(RobotControl, TheMotorGivesItsEffortAndNoMore) {
  World world;
  Robot robot(parse(pendulum_urdf("<limit effort='5' velocity='10'/><dynamics damping='2'/>")), {},
              world.world);
  robot.motors().set_position_target(0, 1.5);
  for (int step = 0; step < 1200; ++step) {
    world.step(robot, dt);
    ASSERT_LE(std::abs(robot.motor_torques()[0]), 5.0 + 1e-9);
  }
  EXPECT_NEAR(robot.motor_torques()[0], 5.0, 1e-9);
  EXPECT_NEAR(robot.positions()[0], std::asin(5.0 / 9.81), 1e-4);
  robot.motors().set_effort_limit(0, 2.0);
  for (int step = 0; step < 1200; ++step) world.step(robot, dt);
  EXPECT_NEAR(robot.positions()[0], std::asin(2.0 / 9.81), 1e-4);
  EXPECT_THROW(robot.motors().set_effort_limit(0, 0.0), UsageError);
}

// A force F at the bob adds its moment about the hinge to what the motor holds.
TEST(RobotControl, ExternalForcesActForOneStepAndAreReadAtTheMotor) {
  World world;
  Robot robot(parse(pendulum_urdf("")), {}, world.world);
  const int bob = robot.model().link_index("bob");
  for (int step = 0; step < 240; ++step) {
    robot.add_external_force(bob, Vec3(3, 0, 0), robot.link_pose_W(bob) * Vec3(0, 0, -0.5));
    world.step(robot, dt);
  }
  // Positive rotation about y carries the hanging bob towards -x.
  EXPECT_NEAR(robot.motor_torques()[0], 1.5, 1e-6);
  EXPECT_NEAR(robot.positions()[0], 0.0, 1e-6);
  for (int step = 0; step < 240; ++step) world.step(robot, dt);
  EXPECT_NEAR(robot.motor_torques()[0], 0.0, 1e-6);
}

TEST(RobotControl, RefusesWhatCannotBe) {
  World world;
  const RobotDescription pendulum = parse(pendulum_urdf(""));
  RobotSettings settings;
  settings.position_gain = 0.0;
  EXPECT_THROW(Robot(pendulum, settings, world.world), UsageError);
  settings = {};
  settings.fixed_base = false;  // the base is a mere frame
  EXPECT_THROW(Robot(pendulum, settings, world.world), UsageError);
  Robot robot(pendulum, {}, world.world);
  EXPECT_THROW(robot.motors().set_torque(1, 0.0), UsageError);
  EXPECT_THROW(robot.link_pose_W(robot.link("no such link")), UsageError);
  EXPECT_THROW(robot.joint_position("no such joint"), UsageError);
  EXPECT_THROW(robot.reset(VectorXd::Zero(2), VectorXd::Zero(2)), UsageError);
}

}  // namespace
}  // namespace pedicel::robot
