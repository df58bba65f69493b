#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using testing::World;

constexpr double dt = 1.0 / 240.0;

std::uint64_t hash_of(const Robot& robot) {
  StateHash hash;
  robot.add_to(hash);
  return hash.value();
}

void move(World& world, Robot& robot, int from, int to) {
  for (int step = from; step < to; ++step) {
    for (int i = 0; i < robot.model().dofs(); ++i)
      robot.motors().set_position_target(i, 0.5 + 0.3 * std::sin(0.02 * step + i), 0.0);
    world.step(robot, dt);
  }
}

TEST(RobotState, TwoRunsAndARestartGiveTheSameBits) {
  const RobotDescription description = load_urdf(testing::asset("stalk6"));
  World first, second;
  Robot a(description, {}, first.world), b(description, {}, second.world);
  move(first, a, 0, 120);
  move(second, b, 0, 60);
  const RobotState half = b.state();
  move(second, b, 60, 120);
  EXPECT_EQ(hash_of(a), hash_of(b));
  b.set_state(half);
  EXPECT_NE(hash_of(a), hash_of(b));
  move(second, b, 60, 120);
  EXPECT_EQ(hash_of(a), hash_of(b));
  EXPECT_THROW(a.set_state({}), UsageError);
}

TEST(RobotState, ResetPutsEveryLinkWhereTheModelSays) {
  World world;
  Robot robot(load_urdf(testing::asset("stalk6")), {}, world.world);
  Random random(41);
  const VectorXd q = testing::random_positions(robot.model(), random);
  robot.reset(q, VectorXd::Zero(7));
  EXPECT_EQ(robot.positions(), q);
  const Pose tool = robot.model().link_pose(q, robot.model().link_index("tool"));
  EXPECT_NEAR((robot.link_pose_W(robot.link("tool")).position - tool.position).norm(), 0.0, 1e-12);
  EXPECT_EQ(robot.joint_position("finger_joint_mirror"), q[6]);
}

TEST(RobotState, TakesItsObjectsOutOfTheWorld) {
  World world;
  {
    Robot robot(load_urdf(testing::asset("stalk6")), {}, world.world);
    EXPECT_EQ(world.world.getNumMultibodies(), 1);
    EXPECT_EQ(world.world.getNumMultiBodyConstraints(), 1);
    world.step(robot, dt);
  }
  EXPECT_EQ(world.world.getNumMultibodies(), 0);
  EXPECT_EQ(world.world.getNumMultiBodyConstraints(), 0);
  EXPECT_EQ(world.world.getNumCollisionObjects(), 0);
}

// A rod that floats: its root falls freely, and links keep their places relative to it.
TEST(RobotState, AFloatingBaseFalls) {
  World world;
  RobotDescription description = testing::parse(testing::pendulum_urdf(""));
  description.links[0].inertial = {1.0, Vec3(0.1, 0, 0), 0.01 * Mat3::Identity()};
  RobotSettings settings;
  settings.fixed_base = false;
  settings.base_pose.position = Vec3(0, 0, 5);
  Robot robot(description, settings, world.world);
  for (int step = 0; step < 240; ++step) world.step(robot, dt);
  const double fall = 0.5 * 9.81 * (1.0 + dt);  // semi-implicit Euler over one second
  EXPECT_NEAR(robot.link_pose_W(robot.link("base")).position.z(), 5.0 - fall, 1e-6);
  EXPECT_NEAR(robot.link_twist_W(robot.link("bob")).linear.z(), -9.81, 1e-6);
}

}  // namespace
}  // namespace pedicel::robot
