#include "engine/robot/inverse_kinematics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using ::testing::HasSubstr;

class InverseKinematics : public ::testing::Test {
 protected:
  KinematicModel model_{load_urdf(testing::asset("stalk6"))};
  int tool_ = model_.link_index("tool");
};

TEST_F(InverseKinematics, ReachesEveryPoseThatTheArmCanTake) {
  Random random(21);
  for (int trial = 0; trial < 100; ++trial) {
    const Pose pose = model_.link_pose(testing::random_positions(model_, random), tool_);
    const IkTarget target{tool_, pose.position, pose.rotation, {}};
    const IkResult result = inverse_kinematics(model_, target, model_.neutral());
    ASSERT_TRUE(result.reached) << trial << " " << result.sentence;
    const Pose got = model_.link_pose(result.q, tool_);
    EXPECT_LE((got.position - pose.position).norm(), 1e-5);
    EXPECT_LE(got.rotation.angularDistance(pose.rotation), 1e-4);
    EXPECT_EQ(result.q, model_.clamped(result.q));
    EXPECT_TRUE(result.sentence.empty());
  }
}

TEST_F(InverseKinematics, AnApproachLeavesTheTurnAboutItFree) {
  const Vec3 down = -Vec3::UnitZ();
  const IkTarget target{tool_, Vec3(0.25, 0.1, 0.15), {}, down};
  const IkResult result = inverse_kinematics(model_, target, model_.neutral());
  ASSERT_TRUE(result.reached);
  const Pose got = model_.link_pose(result.q, tool_);
  EXPECT_NEAR((got.rotation * Vec3::UnitZ() - down).norm(), 0.0, 1e-4);
}

TEST_F(InverseKinematics, HeldJointsKeepTheirValue) {
  VectorXd start = model_.neutral();
  start[0] = 0.4;
  start[6] = 0.02;
  IkSettings settings;
  settings.held = {0, 6};
  VectorXd q = start;
  q[1] = 0.3;
  q[2] = 1.2;
  const IkTarget target{tool_, model_.link_pose(q, tool_).position, {}, {}};
  const IkResult result = inverse_kinematics(model_, target, start, settings);
  ASSERT_TRUE(result.reached);
  EXPECT_EQ(result.q[0], 0.4);
  EXPECT_EQ(result.q[6], 0.02);
}

// Straight up, the arm reaches 0.2435 + 0.2002 + |(0.087, 0.22761)| + 0.0625 + 0.12 m above its
// base where the forearm points to the wrist's own line; beyond, the nearest point is that one.
TEST_F(InverseKinematics, SaysPlainlyHowFarAwayTheNearestPointIs) {
  const double top = 0.2435 + 0.2002 + std::hypot(0.087, 0.22761) + 0.0625 + 0.12;
  const IkTarget target{tool_, Vec3(0, 0, top + 0.038), {}, {}};
  const IkResult result = inverse_kinematics(model_, target, model_.neutral());
  EXPECT_FALSE(result.reached);
  EXPECT_EQ(result.sentence, "unreachable: nearest reachable point is 38 mm away");
}

TEST_F(InverseKinematics, SaysWhenOnlyTheOrientationIsOutOfReach) {
  const double top = 0.2435 + 0.2002 + std::hypot(0.087, 0.22761) + 0.0625 + 0.12;
  const IkTarget target{tool_, Vec3(0, 0, top - 0.01), {}, Vec3(-Vec3::UnitZ())};
  const IkResult result = inverse_kinematics(model_, target, model_.neutral());
  EXPECT_FALSE(result.reached);
  EXPECT_THAT(result.sentence,
              HasSubstr("unreachable in this orientation: nearest reachable pose"));
}

TEST_F(InverseKinematics, SolutionsAreDifferentSortedAndAllValid) {
  VectorXd start = model_.neutral();
  start[2] = 1.0;
  Random random(22);
  const Pose pose = model_.link_pose(testing::random_positions(model_, random, 0.4), tool_);
  const IkTarget target{tool_, pose.position, pose.rotation, {}};
  const std::vector<VectorXd> solutions = ik_solutions(model_, target, start);
  ASSERT_GE(solutions.size(), 2u);
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    EXPECT_LE(ik_error(model_.link_pose(solutions[i], tool_), target).first, 1e-5);
    const double before = i > 0 ? (solutions[i - 1] - start).norm() : 0.0;
    EXPECT_GE((solutions[i] - start).norm(), before);
  }
}

TEST_F(InverseKinematics, TheSameSeedGivesTheSameBits) {
  const IkTarget target{tool_, Vec3(-0.2, 0.2, 0.3), {}, Vec3::UnitY()};
  const IkResult a = inverse_kinematics(model_, target, model_.neutral());
  const IkResult b = inverse_kinematics(model_, target, model_.neutral());
  EXPECT_EQ(a.q, b.q);
}

TEST_F(InverseKinematics, LoyaltyPrefersTheDescentFromTheStart) {
  const IkTarget target{tool_, Vec3(0.9, 0.6, 0.5), Quat::Identity(), {}};
  VectorXd start = model_.neutral();
  start[1] = 0.4;
  const IkResult own = descend(model_, target, start);
  ASSERT_FALSE(own.reached);
  const IkResult best = inverse_kinematics(model_, target, start);
  IkSettings settings;
  settings.start_preference = 1e6;
  const IkResult loyal = inverse_kinematics(model_, target, start, settings);
  EXPECT_THAT(loyal.sentence, HasSubstr("unreachable"));
  EXPECT_NEAR(loyal.position_error, own.position_error, 1e-12);
  EXPECT_LE(std::hypot(best.position_error, 0.1 * best.rotation_error),
            std::hypot(own.position_error, 0.1 * own.rotation_error) + 1e-12);
}

}  // namespace
}  // namespace pedicel::robot
