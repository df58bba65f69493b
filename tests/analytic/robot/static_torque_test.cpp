#include <gtest/gtest.h>

#include "engine/robot/dynamics.h"
#include "tests/unit/robot/robot_cases.h"

// At rest the torque of each joint balances gravity by virtual work: tau_i = dV/dq_i with
// V = -sum m_k g . c_k(q), the centres of mass c_k from the forward kinematics, differentiated by
// central differences. Neither Bullet nor the recursive algorithm enters the reference.
namespace pedicel::robot {
namespace {

using Eigen::VectorXd;

VectorXd virtual_work(const RobotDescription& robot, const KinematicModel& model,
                      const VectorXd& q) {
  const auto potential = [&](const VectorXd& at) {
    std::vector<Pose> poses;
    model.link_poses(at, poses);
    double sum = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i)
      sum += 9.81 * robot.links[i].inertial.mass * (poses[i] * robot.links[i].inertial.com_L).z();
    return sum;
  };
  VectorXd torque(q.size());
  const double h = 1e-5;
  for (int i = 0; i < q.size(); ++i) {
    VectorXd low = q, high = q;
    low[i] -= h;
    high[i] += h;
    torque[i] = (potential(high) - potential(low)) / (2.0 * h);
  }
  return torque;
}

class StaticTorque : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Robots, StaticTorque, ::testing::Values("stalk6", "gantry_gripper"));

TEST_P(StaticTorque, MotorsReadWhatVirtualWorkSays) {
  testing::World world;
  RobotDescription description = load_urdf(testing::asset(GetParam()));
  RobotSettings settings;
  settings.base_pose.rotation = Eigen::AngleAxisd(0.3, Vec3::UnitX());  // gravity on every axis
  Robot robot(description, settings, world.world);
  Random random(61);
  for (int trial = 0; trial < 10; ++trial) {
    const VectorXd q = testing::random_positions(robot.model(), random);
    robot.reset(q, VectorXd::Zero(q.size()));
    for (int step = 0; step < 60; ++step) world.step(robot, 1.0 / 240.0);
    const VectorXd expected = virtual_work(description, robot.model(), q);
    EXPECT_LT((robot.motor_torques() - expected).cwiseAbs().maxCoeff(),
              1e-6 * expected.cwiseAbs().maxCoeff());
    EXPECT_LT((robot.positions() - q).cwiseAbs().maxCoeff(), 1e-7);
  }
}

// In motion: the power of the inverse dynamics is the rate of kinetic plus potential energy,
//   tau . qd = d/dt (T + V) along q(t), for any qdd.
TEST_P(StaticTorque, InverseDynamicsBalancesPower) {
  const RobotDescription description = load_urdf(testing::asset(GetParam()));
  const KinematicModel model(description);
  Dynamics dynamics(description, model);
  const Vec3 gravity(1.0, -2.0, -9.0);
  Random random(62);
  const double h = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = testing::random_positions(model, random, 0.5);
    const VectorXd qd = testing::random_positions(model, random),
                   qdd = testing::random_positions(model, random);
    const auto energy = [&](double t) {
      const VectorXd at = q + t * qd + 0.5 * t * t * qdd, rate = qd + t * qdd;
      return dynamics.kinetic_energy(at, rate) + dynamics.potential_energy(at, gravity);
    };
    const double rate = (energy(h) - energy(-h)) / (2.0 * h);
    EXPECT_NEAR(dynamics.inverse(q, qd, qdd, gravity).dot(qd), rate, 1e-6 * (1.0 + std::abs(rate)));
  }
}

}  // namespace
}  // namespace pedicel::robot
