#include "engine/robot/joint_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

std::string said(const std::string& type, double low, double high, double value) {
  const RobotDescription robot = testing::parse(
      testing::pendulum_urdf("<limit lower='" + std::to_string(low) + "' upper='" +
                                 std::to_string(high) + "' effort='1' velocity='1'/>",
                             type));
  return outside_range(KinematicModel(robot), 0, value).value_or("");
}

TEST(JointRange, SaysTheRangeAndTheOtherUnitWhereItFits) {
  EXPECT_EQ(said("revolute", -2, 2, 2.0), "");
  EXPECT_EQ(said("revolute", -2, 2, 90.0),
            "hinge = 90, expected -2 to 2 rad; degrees? 90 degrees are 1.571 rad");
  EXPECT_EQ(said("revolute", -2, 2, 180.0), "hinge = 180, expected -2 to 2 rad");
  EXPECT_EQ(said("prismatic", 0, 0.025, 20.0),
            "hinge = 20, expected 0 to 0.025 m; millimetres? 20 millimetres are 0.02 m");
  EXPECT_EQ(said("prismatic", 0, 0.025, 1.0),
            "hinge = 1, expected 0 to 0.025 m; millimetres? 1 millimetres are 0.001 m");
  EXPECT_NE(said("revolute", -2, 2, std::nan("")), "");
}

TEST(JointRange, LeavesTheSlackThatIsAskedFor) {
  const RobotDescription robot = testing::parse(
      testing::pendulum_urdf("<limit lower='-1' upper='1' effort='1' velocity='1'/>", "revolute"));
  EXPECT_FALSE(outside_range(KinematicModel(robot), 0, 1.0009, 0.001));
  EXPECT_TRUE(outside_range(KinematicModel(robot), 0, 1.0011, 0.001));
}

TEST(JointRange, DoubtsManyTurnsOfAJointWithoutLimits) {
  const RobotDescription robot = testing::parse(testing::pendulum_urdf(""));
  const KinematicModel model(robot);
  EXPECT_FALSE(many_turns(model, 0, 6.0));
  EXPECT_THAT(many_turns(model, 0, 90.0).value_or(""),
              HasSubstr("hinge = 90 rad are 14.3 turns; degrees? 90 degrees are 1.571 rad"));
}

}  // namespace
}  // namespace pedicel::robot
