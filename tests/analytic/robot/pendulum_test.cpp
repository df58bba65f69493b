#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

// A physical pendulum of mass m, whose centre of mass lies l below the hinge, with inertia I about
// the hinge swings with the amplitude a at the period
//   T = T0 / agm(1, cos(a / 2)),   T0 = 2 pi sqrt(I / (m g l)),
// where agm is the arithmetic-geometric mean (exact: T = T0 2/pi K(sin(a/2)), and Gauss's relation
// K(k) = pi / (2 agm(1, sqrt(1 - k^2)))). Here m = 2 kg, l = 0.5 m, I = 0.01 + m l^2 = 0.51 kg m2.
namespace pedicel::robot {
namespace {

using testing::pi;

double exact_period(double amplitude) {
  double a = 1.0, g = std::cos(0.5 * amplitude);
  for (int i = 0; i < 10; ++i) {
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
  }
  return 2.0 * pi * std::sqrt(0.51 / (2.0 * 9.81 * 0.5)) / a;
}

/// Mean period over five swings, from the upward passages through the lowest point.
double measured_period(double amplitude, double dt, bool rk4) {
  testing::World world;
  RobotSettings settings;
  settings.rk4 = rk4;
  Robot robot(testing::parse(testing::pendulum_urdf("")), settings, world.world);
  robot.reset(Eigen::VectorXd::Constant(1, amplitude), Eigen::VectorXd::Zero(1));
  robot.motors().set_torque(0, 0.0);
  double first = 0.0, last = 0.0, before = amplitude;
  int passages = 0;
  for (int step = 1; passages < 6; ++step) {
    world.step(robot, dt);
    const double now = robot.positions()[0];
    if (before < 0.0 && now >= 0.0) {
      last = (step - now / (now - before)) * dt;
      if (passages++ == 0) first = last;
    }
    before = now;
  }
  return (last - first) / 5.0;
}

TEST(Pendulum, PeriodWithinAThousandthAtEveryAmplitude) {
  for (double amplitude : {0.05, 0.5, 1.5, 2.8}) {
    const double exact = exact_period(amplitude);
    EXPECT_NEAR(measured_period(amplitude, 1e-3, true) / exact, 1.0, 1e-4) << amplitude;
    EXPECT_NEAR(measured_period(amplitude, 1e-3, false) / exact, 1.0, 1e-3) << amplitude;
  }
}

}  // namespace
}  // namespace pedicel::robot
