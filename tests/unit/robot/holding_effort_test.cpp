#include "engine/robot/holding_effort.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

const Vec3 gravity(0.0, 0.0, -9.81);

/// The pendulum of 2 kg at 0.5 m held level: 9.81 N m.
std::optional<std::string> said(double effort, double friction, double angle = 0.5 * M_PI) {
  const RobotDescription robot = testing::parse(testing::pendulum_urdf(
      "<limit effort='" + std::to_string(effort) + "' velocity='1'/><dynamics friction='" +
      std::to_string(friction) + "'/>"));
  return too_weak_to_hold(robot, KinematicModel(robot), Eigen::VectorXd::Constant(1, angle),
                          gravity);
}

TEST(HoldingEffort, SaysWhatIsNeededAndWhatThereIs) {
  EXPECT_EQ(said(4.0, 0.0).value_or(""),
            "joint 'hinge' sags: to hold the robot at its start takes 9.81 N m, its effort is 4 "
            "N m");
  EXPECT_FALSE(said(9.82, 0.0));
  EXPECT_FALSE(said(4.0, 5.9)) << "friction holds the rest";
  EXPECT_TRUE(said(4.0, 5.7));
  EXPECT_FALSE(said(0.1, 0.0, 0.0)) << "it hangs";
  EXPECT_FALSE(said(0.0, 0.0)) << "no limit";
}

TEST(HoldingEffort, NamesTheWeakestAndCountsTheOthers) {
  std::string text = "<robot name='r'><link name='l0'/>";
  const double efforts[] = {30.0, 1.0, 0.1};  // N m, all of them too little
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i + 1), before = std::to_string(i);
    text += "<link name='l" + n + "'>" + testing::inertial(2.0, "0.2 0 0", "0.01", "0.01", "0.01") +
            "</link><joint name='j" + n + "' type='continuous'><parent link='l" + before +
            "'/><child link='l" + n +
            "'/><origin xyz='0.4 0 0'/><axis xyz='0 1 0'/><limit effort='" +
            std::to_string(efforts[i]) + "' velocity='1'/></joint>";
  }
  const RobotDescription robot = testing::parse(text + "</robot>");
  const std::string sentence =
      too_weak_to_hold(robot, KinematicModel(robot), Eigen::VectorXd::Zero(3), gravity)
          .value_or("");
  EXPECT_THAT(sentence, HasSubstr("joint 'j3' sags"));
  EXPECT_THAT(sentence, HasSubstr("takes 3.924 N m, its effort is 0.1 N m (2 more joints of this "
                                  "kind)"));
}

// The sentence and the simulation agree.
TEST(HoldingEffort, WhatItSaysHappens) {
  for (const double effort : {9.0, 10.5}) {
    const RobotDescription robot = testing::parse(
        testing::pendulum_urdf("<limit effort='" + std::to_string(effort) + "' velocity='10'/>"));
    testing::World world;
    Robot body(robot, {}, world.world);
    const Eigen::VectorXd level = Eigen::VectorXd::Constant(1, 0.5 * M_PI);
    body.reset(level, Eigen::VectorXd::Zero(1));
    for (int i = 0; i < 120; ++i) world.step(body, 1.0 / 240.0);
    const bool moved = std::abs(body.positions()[0] - level[0]) > 0.01;
    EXPECT_EQ(moved, too_weak_to_hold(robot, body.model(), level, gravity).has_value()) << effort;
  }
}

}  // namespace
}  // namespace pedicel::robot
