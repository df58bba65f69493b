#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

// A robot without motors, damping and friction keeps its energy. Runge-Kutta 4 loses next to
// nothing; Bullet's default integrator is of first order: half the step, half the error.
namespace pedicel::robot {
namespace {

/// The arm alone, every joint free.
RobotDescription passive_arm() {
  RobotDescription robot = load_urdf(testing::asset("stalk6"));
  for (Joint& joint : robot.joints) {
    joint.damping = joint.friction = 0.0;
    joint.lower = -Joint::unlimited;
    joint.upper = Joint::unlimited;
    joint.mimic.reset();
    if (joint.type == JointType::prismatic) joint.type = JointType::fixed;
  }
  return robot;
}

/// Largest departure from the energy at the start, J, over half a second from a bent pose.
double energy_error(double dt, bool rk4) {
  testing::World world;
  RobotSettings settings;
  settings.rk4 = rk4;
  Robot robot(passive_arm(), settings, world.world);
  Eigen::VectorXd q(6);
  q << 0.2, 0.9, 1.4, 0.3, 0.5, 0.0;
  robot.reset(q, Eigen::VectorXd::Zero(6));
  for (int i = 0; i < 6; ++i) robot.motors().set_torque(i, 0.0);
  const double start = robot.energy();
  double worst = 0.0;
  for (int step = 0; step * dt < 0.5; ++step) {
    world.step(robot, dt);
    worst = std::max(worst, std::abs(robot.energy() - start));
  }
  return worst;
}

TEST(PassiveEnergy, RungeKuttaKeepsItAndTheDefaultIsOfFirstOrder) {
  const double coarse = energy_error(1e-3, false), fine = energy_error(5e-4, false);
  EXPECT_NEAR(coarse / fine, 2.0, 0.2);
  const double rk4 = energy_error(1e-3, true);
  EXPECT_LT(rk4, 1e-5);
  EXPECT_LT(rk4, 0.01 * fine);
}

}  // namespace
}  // namespace pedicel::robot
