// The log of a run says what the run did: joints, frames, forces at the wrist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/logs/logged_run.h"

namespace pedicel::app {
namespace {

using discrepancy::LogContents;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

class RunLog : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = std::make_unique<LoggedRun>("0.3");  // the stem is out of reach
    log_ = std::make_unique<LogContents>(discrepancy::read_log(run_->log_file()));
  }
  static void TearDownTestSuite() { run_.reset(), log_.reset(); }
  static std::unique_ptr<LoggedRun> run_;
  static std::unique_ptr<LogContents> log_;
};
std::unique_ptr<LoggedRun> RunLog::run_;
std::unique_ptr<LogContents> RunLog::log_;

TEST_F(RunLog, HasItsTopics) {
  EXPECT_TRUE(log_->whole);
  std::vector<std::string> names;
  for (const discrepancy::LogTopic& topic : log_->topics) {
    names.push_back(topic.name);
    EXPECT_EQ(topic.malformed, 0U) << topic.name;
  }
  EXPECT_THAT(names, UnorderedElementsAre("/clock", "/robot_description", "/joint_states",
                                          "/joint_commands", "/tf", "/tf_static", "/organ_forces",
                                          "/plant", "/wrist/wrench"));
  EXPECT_EQ(log_->topic("/clock")->messages, 121U);
  EXPECT_EQ(log_->topic("/plant")->messages, 13U);
  EXPECT_EQ(log_->texts.at("/robot_description").front().value, discrepancy::ArmAtStem::urdf());
}

// Joints are told at each step of 1 ms, all else and the table every 10 ms.
constexpr std::size_t steps_a_row = 10;

TEST_F(RunLog, JointsAreThoseOfTheTable) {
  Diagnostics diagnostics;
  const io::CsvTable table = io::read_csv(run_->path("out/log.csv"), {true, true}, diagnostics);
  const int column = table.column("joint_turn_rad");
  const auto& states = log_->joints.at("/joint_states");
  EXPECT_THAT(states.front().value.names, ElementsAre("turn"));
  EXPECT_EQ(states.front().stamp, 0.0);
  // The table begins after the first step.
  ASSERT_EQ(states.size(), steps_a_row * (table.rows.size() - 1) + 1);
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const auto& state = states[steps_a_row * i];
    EXPECT_NEAR(state.stamp, table.rows[i][0], 1e-9);
    EXPECT_NEAR(state.value.position[0], table.rows[i][static_cast<std::size_t>(column)], 1e-8);
    EXPECT_NEAR(state.value.position[0], run_->joint(state.stamp), 2e-3);
  }
  EXPECT_NEAR(log_->joints.at("/joint_commands").back().value.position[0], 0.12, 1e-6);
}

TEST_F(RunLog, FramesLeadFromTheWorldToTheFinger) {
  const auto& states = log_->joints.at("/joint_states");
  for (std::size_t i = 0; i < states.size(); i += steps_a_row) {
    const auto& state = states[i];
    const double q = state.value.position[0];
    const Pose finger = discrepancy::frame_at(*log_, "finger", "world", state.stamp, false);
    EXPECT_LT((finger.position - Vec3(0.4 * std::cos(q), 0.4 * std::sin(q), 0.3)).norm(), 1e-9);
    EXPECT_NEAR(finger.rotation.angularDistance(Quat(Eigen::AngleAxisd(q, Vec3::UnitZ()))), 0.0,
                1e-9);
  }
  // The stem's far end stands where it is drawn, 0.6 m high.
  const Pose tip = discrepancy::frame_at(*log_, "bush/stem", "world", 0.5, false);
  EXPECT_LT((tip.position - Vec3(0.4, 0.3, 0.6)).norm(), 1e-6);
  // Half way between two messages.
  const Pose between = discrepancy::frame_at(*log_, "finger", "world", 0.505, false);
  EXPECT_NEAR(std::atan2(between.position.y(), between.position.x()), run_->joint(0.505), 2e-3);
  EXPECT_TRUE(discrepancy::frame_at(*log_, "nobody", "world", 0.5, false).position.hasNaN());
  EXPECT_TRUE(discrepancy::frame_at(*log_, "finger", "world", 9.0, false).position.hasNaN());
}

// Newton and Euler for one body that turns about the vertical with q(t): arm (0.3 kg at 0.2 m) and
// finger (0.05 kg at 0.4 m, 0.02 m higher).
TEST_F(RunLog, TheWristBearsWeightAndInertia) {
  constexpr double m = 0.35, x = (0.3 * 0.2 + 0.05 * 0.4) / m, z = 0.05 * 0.02 / m, g = 9.81;
  constexpr double h = 1e-4;
  int checked = 0;
  for (const auto& one : log_->wrenches.at("/wrist/wrench")) {
    const double t = one.stamp;
    EXPECT_EQ(one.value.header.frame_id, "arm");
    const double rate = (run_->joint(t + h) - run_->joint(t - h)) / (2 * h);
    const double second = (run_->joint(t + h) - 2 * run_->joint(t) + run_->joint(t - h)) / (h * h);
    const ros::Wrench& w = one.value.wrench;
    EXPECT_NEAR(w.force.z, -m * g, 1e-6);
    EXPECT_NEAR(w.torque.y, x * m * g + z * m * x * rate * rate, 2e-3);
    // The path has corners of its acceleration, and the motor follows within its stiffness.
    EXPECT_NEAR(w.force.x, m * x * rate * rate, 5e-3) << t;
    EXPECT_NEAR(w.force.y, -m * x * second, 0.05) << t;
    checked += std::abs(second) > 0.3;
  }
  EXPECT_GT(checked, 300) << "it is looked at while it moves";
}

TEST(RunLogAtAStem, TheWristFeelsThePush) {
  const LoggedRun run("0.03");
  const LogContents log = discrepancy::read_log(run.log_file());
  // At rest against the stem the push is all that acts along y of the arm.
  double push = 0.0;
  int samples = 0;
  for (const auto& one : log.wrenches.at("/wrist/wrench"))
    if (one.stamp > 1.15) push += one.value.wrench.force.y, ++samples;
  ASSERT_GT(samples, 10);
  Diagnostics diagnostics;
  const io::CsvTable table = io::read_csv(run.path("out/log.csv"), {true, true}, diagnostics);
  const double normal =
      table.rows.back()[static_cast<std::size_t>(table.column("contact_arm/finger_normal_N"))];
  ASSERT_GT(normal, 0.1);
  EXPECT_NEAR(-push / samples, normal, 0.1 * normal);
}

}  // namespace
}  // namespace pedicel::app
