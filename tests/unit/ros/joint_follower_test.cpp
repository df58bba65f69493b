// Joints along paths that come from outside: what is refused, and where they go.
#include "app/ros/joint_follower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/scene_reader.h"
#include "plugins/simulation/simulation.h"
#include "tests/support/places.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Follower : public ::testing::Test {
 protected:
  Follower() {
    Diagnostics diagnostics;
    auto scene = world::read_scene(
        pedicel::test::source_folder() / "assets/scenes/cherry_tomato_pull_up.scene.yaml",
        diagnostics);
    scene->plants.clear();
    scene->expectations.clear();
    scene->robot->waypoints.clear();
    scene_ = std::move(*scene);
    simulation_ = std::make_unique<simulation::Simulation>(scene_, simulation::SimulationOptions{});
    follower_ = std::make_unique<JointFollower>(*simulation_->robot());
    simulation_->world().add(*follower_);
  }
  static ros::JointTrajectory path(std::vector<std::string> joints,
                                   std::vector<std::pair<double, std::vector<double>>> points) {
    ros::JointTrajectory message;
    message.joint_names = std::move(joints);
    for (auto& [time, positions] : points)
      message.points.push_back({positions, {}, {}, {}, ros::stamp_of<ros::Duration>(time)});
    return message;
  }
  std::string refusal(const ros::JointTrajectory& message) {
    std::string fault;
    EXPECT_FALSE(follower_->plan(message, simulation_->world().time(), fault));
    return fault;
  }
  int follow(const ros::JointTrajectory& message) {
    std::string fault;
    auto plan = follower_->plan(message, simulation_->world().time(), fault);
    EXPECT_TRUE(plan) << fault;
    return plan ? follower_->follow(std::move(*plan)) : -1;
  }
  void run(double seconds) {
    const double end = simulation_->world().time() + seconds;
    while (simulation_->world().time() < end - 1e-9) simulation_->step();
  }
  double joint(const char* name) const {
    return simulation_->robot()->robot().joint_position(name);
  }

  world::Scene scene_;
  std::unique_ptr<simulation::Simulation> simulation_;
  std::unique_ptr<JointFollower> follower_;
};

TEST_F(Follower, RefusesWhatMakesNoSense) {
  EXPECT_THAT(refusal(path({}, {{1, {}}})), HasSubstr("no joint_names"));
  EXPECT_THAT(refusal(path({"elbow9"}, {{1, {0}}})), HasSubstr("no joint \"elbow9\""));
  EXPECT_THAT(refusal(path({"joint1", "joint1"}, {{1, {0, 0}}})), HasSubstr("appears twice"));
  EXPECT_THAT(refusal(path({"joint1"}, {})), HasSubstr("no points"));
  const auto no_position = HasSubstr("a point without a position of each joint");
  EXPECT_THAT(refusal(path({"joint1"}, {{1, {0, 0}}})), no_position);
  for (const double none : {std::nan(""), -1.0 / 0.0, 1.0e308, -1.0e308})
    EXPECT_THAT(refusal(path({"joint1"}, {{1, {none}}})), no_position);
  EXPECT_THAT(refusal(path({"joint1"}, {{1, {0}}, {1, {0.1}}})), HasSubstr("does not increase"));
  EXPECT_THAT(refusal(path({"joint1"}, {{0, {1}}, {0.1, {0.1}}})), HasSubstr("farther away"));
  run(1.0);
  ros::JointTrajectory old = path({"joint1"}, {{0.1, {0}}});
  old.header.stamp = ros::stamp_of(0.1);
  EXPECT_THAT(refusal(old), HasSubstr("it ended before now"));
}

TEST_F(Follower, TwoPathsAtOnceEachHaveTheirJoints) {
  const int arm = follow(path({"joint1", "joint2"}, {{0.5, {0.2, 0.1}}, {1.0, {0.3, 0.0}}}));
  run(0.5);
  EXPECT_NEAR(joint("joint1"), 0.2, 0.01);
  const int hand = follow(path({"finger_joint"}, {{0.5, {0.01}}}));
  run(0.7);
  EXPECT_NEAR(joint("joint1"), 0.3, 0.005);
  EXPECT_NEAR(joint("joint2"), 0.0, 0.005);
  EXPECT_NEAR(joint("finger_joint"), 0.01, 0.001);
  EXPECT_TRUE(follower_->follows(arm, {0, 1}));
  const int other = follow(path({"joint2"}, {{0.5, {0.1}}}));
  EXPECT_FALSE(follower_->follows(arm, {0, 1})) << "one of its joints has another path";
  EXPECT_TRUE(follower_->follows(other, {1}));
  EXPECT_TRUE(follower_->follows(hand, {6}));
}

TEST_F(Follower, HoldsWhereItIsToldTo) {
  follow(path({"joint1"}, {{2.0, {1.0}}}));
  run(1.0);
  follower_->hold({0});
  const double there = follower_->target(0);
  EXPECT_NEAR(there, 0.5, 0.2);
  run(1.0);
  EXPECT_NEAR(joint("joint1"), there, 0.005);
}

TEST_F(Follower, APointAtOnceIsReachedAsFastAsJointsGo) {
  follow(path({"joint1"}, {{0, {0.5}}}));
  run(0.25);
  EXPECT_LT(joint("joint1"), 0.45) << "no jump";
  run(0.5);
  EXPECT_NEAR(joint("joint1"), 0.5, 0.01);
}

TEST_F(Follower, BeginsAtItsStamp) {
  ros::JointTrajectory later = path({"joint1"}, {{0.5, {0.2}}});
  later.header.stamp = ros::stamp_of(1.0);
  follow(later);
  run(1.0);
  EXPECT_NEAR(joint("joint1"), 0.0, 0.002);
  run(0.6);
  EXPECT_NEAR(joint("joint1"), 0.2, 0.005);
}

}  // namespace
}  // namespace pedicel::app
