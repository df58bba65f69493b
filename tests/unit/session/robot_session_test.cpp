// The robot led by hand: where its tool is asked to go, the ghost of its goal, programs.
#include <gmock/gmock.h>

#include "app/session/session_files.h"
#include "app/session/session_robot.h"
#include "engine/core/timer.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class RobotSession : public ::testing::Test {
 protected:
  RobotSession() : session_(waiting()) {
    EXPECT_TRUE(session_.files().open(source("assets/scenes/cherry_tomato_pull_up.scene.yaml")));
    // To where the arm can go any way.
    must(run("run 1"));
    must(run("stop robot"));
    must(run("run 0.3"));
  }
  Result run(const std::string& line) { return session_.run_text(line); }
  std::shared_ptr<const Snapshot> now() { return session_.snapshot(); }
  ToolGoal goal() { return session_.robot().tool_goal().value(); }
  static std::string text_of(const Vec3& p) {
    return std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z());
  }
  bool within_limits(const Eigen::VectorXd& q) { return kinematics_of(*now()).clamped(q) == q; }
  /// The robot and its joint 1 turned by `by`, at a time.
  void record(double time, double by) {
    Eigen::VectorXd q = now()->robot.q;
    q[0] += by;
    must(session_.run(Command(
        "add waypoint", {{"time", time}, {"joints", std::vector<double>(q.begin(), q.end())}})));
  }

  TemporaryFolder folder_;
  Session session_;
};

TEST_F(RobotSession, TheToolGoesWhereItIsAskedWhileTheGhostShowsTheGoal) {
  const Pose start = goal().asked_W;
  const Vec3 to = start.position + Vec3(0.05, 0.04, 0.03);
  must(run("tool " + text_of(to)));
  EXPECT_TRUE(goal().reached);
  EXPECT_NEAR((goal().asked_W.position - to).norm(), 0.0, 1e-6);
  EXPECT_NEAR(goal().asked_W.rotation.angularDistance(start.rotation), 0.0, 1e-9);
  EXPECT_TRUE(within_limits(now()->robot.goal));
  const auto ghost = robot_ghost(*now());
  ASSERT_TRUE(ghost) << "the arm is not there yet";
  EXPECT_NEAR((ghost->tool.position - to).norm(), 0.0, 1e-4);
  ASSERT_EQ(ghost->links.size(), now()->robot.links.size());
  must(run("run 2"));
  EXPECT_NEAR((now()->robot.tool.position - to).norm(), 0.0, 2e-3);
  EXPECT_FALSE(robot_ghost(*now())) << "it is there";
}

TEST_F(RobotSession, TurnsAboutTheTool) {
  const Pose start = goal().asked_W;
  const Quat turned = Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * start.rotation;
  const Eigen::Vector4d c = turned.coeffs();
  must(session_.run(Command(
      "tool", {{"to", start.position}, {"turn", std::vector<double>(c.begin(), c.end())}})));
  must(run("run 2"));
  EXPECT_NEAR(now()->robot.tool.rotation.angularDistance(turned), 0.0, 0.01);
  EXPECT_NEAR((now()->robot.tool.position - start.position).norm(), 0.0, 2e-3);
  EXPECT_THAT(run("tool 0,0,0 turn=0,0,0,0").text, HasSubstr("not all 0"));
}

TEST_F(RobotSession, OutOfReachIsSaidAndTheNearestPoseTaken) {
  const Eigen::VectorXd before = now()->robot.goal;
  const Result refused = run("tool 2,0,0.5");
  EXPECT_FALSE(refused.ok);
  EXPECT_THAT(refused.text, HasSubstr("unreachable"));
  EXPECT_EQ(now()->robot.goal, before) << "a refusal moves nothing";
  const Result near = run("tool 2,0,0.5 near=1");
  ASSERT_TRUE(near.ok);
  EXPECT_THAT(near.text, HasSubstr("unreachable"));
  const ToolGoal far = goal();
  EXPECT_FALSE(far.reached);
  EXPECT_EQ(far.sentence, near.text);
  EXPECT_EQ(far.asked_W.position, Vec3(2, 0, 0.5));
  EXPECT_LT((far.nearest_W.position - far.asked_W.position).norm(),
            (now()->robot.tool.position - far.asked_W.position).norm())
      << "nearer than it was";
  EXPECT_TRUE(within_limits(now()->robot.goal));
  must(run("run 5"));
  EXPECT_NEAR((now()->robot.tool.position - far.nearest_W.position).norm(), 0.0, 0.01);
  // Told otherwise, the pose that was asked for is forgotten.
  must(run("joint joint1 0.1"));
  EXPECT_TRUE(goal().reached);
  EXPECT_NEAR((goal().asked_W.position - far.nearest_W.position).norm(), 0.0, 1.0);
}

TEST_F(RobotSession, BeyondItsReachALedArmDoesNotJump) {
  must(run("tool 0.9,0.6,0.5 near=1"));
  Eigen::VectorXd last = now()->robot.goal;
  const Timer timer;
  for (int i = 1; i <= 20; ++i) {
    must(run("tool " + text_of(Vec3(0.9, 0.6 - 0.004 * i, 0.5)) + " near=1"));
    EXPECT_LT((now()->robot.goal - last).cwiseAbs().maxCoeff(), 0.3) << i;
    last = now()->robot.goal;
  }
  EXPECT_LT(timer.seconds() / 20, 0.25) << "s, one move of the hand";
  EXPECT_THAT(session_.log().back(), HasSubstr("tool "));
  EXPECT_THAT(session_.log()[session_.log().size() - 2], HasSubstr("run "))
      << "a drag is one line of the log";
  RecordProperty("ms_per_move", static_cast<int>(1e3 * timer.seconds() / 20));
}

TEST_F(RobotSession, JogGoesOnFromWhereTheToolIsToBe) {
  const Vec3 start = goal().asked_W.position;
  must(run("jog 0.02,0,0"));
  must(run("jog 0.02,0,0"));
  EXPECT_NEAR((goal().asked_W.position - start - Vec3(0.04, 0, 0)).norm(), 0.0, 1e-4);
  must(run("jog 0,0,0 turn=0,0,0.1"));
  EXPECT_NEAR((goal().asked_W.position - start - Vec3(0.04, 0, 0)).norm(), 0.0, 1e-4);
}

TEST_F(RobotSession, WaypointsAreSavedAndLoadedAsTheyAre) {
  record(1, 0.1);
  record(2.5, 0.2);
  const std::vector<RobotWaypoint> saved = session_.document().waypoints;
  const std::uint64_t hash = session_.document().state_hash();
  const std::string file = (folder_ / "way.csv").string();
  must(run("save waypoints " + file));
  must(run("clear waypoints"));
  must(run("load waypoints " + file));
  EXPECT_EQ(session_.document().waypoints, saved);
  EXPECT_EQ(session_.document().state_hash(), hash) << "to the last digit";
  must(run("undo"));
  EXPECT_TRUE(session_.document().waypoints.empty());
  // The file is what `play trajectory` takes.
  must(run("play trajectory " + file));
  EXPECT_NEAR(now()->robot.program_duration, 2.5, 1e-12);
  EXPECT_THAT(run("load waypoints " + (folder_ / "none.csv").string()).text, HasSubstr("none.csv"));
  EXPECT_FALSE(run("set waypoints 1,2 0.1,0.2,0.3").ok);
  EXPECT_FALSE(run("set waypoints 2,1 0.1,0.2").ok);
  must(run("clear waypoints"));
  EXPECT_THAT(run("save waypoints " + file).text, HasSubstr("no waypoints"));
}

TEST_F(RobotSession, ALoopGoesOnUntilItIsStopped) {
  const double start = now()->robot.q[0];
  record(0.2, 0.1);
  record(0.5, 0.0);
  must(run("play waypoints loop=1"));
  EXPECT_TRUE(now()->robot.loops);
  EXPECT_FALSE(robot_ghost(*now())) << "no end to show";
  // The way to the first takes 0.2 s, a lap 0.3 s and the way back: 1.5 x 0.1 rad at 1 rad/s.
  must(run("run 0.3"));
  EXPECT_NEAR(now()->robot.program_duration, 0.45, 1e-9);
  const double lap = now()->robot.program_duration;
  const double q = now()->robot.q[0];
  must(run("run 0.9"));
  EXPECT_TRUE(now()->robot.follows_program);
  EXPECT_NEAR(now()->robot.program_time, std::fmod(1.2 - 0.2, lap), 1e-6);
  EXPECT_NEAR(now()->robot.q[0], q, 5e-3) << "two laps later";
  EXPECT_GT(std::abs(q - start), 0.01);
  must(run("stop robot"));
  EXPECT_FALSE(now()->robot.follows_program);
  const Eigen::VectorXd held = now()->robot.q;
  must(run("run 0.5"));
  EXPECT_LT((now()->robot.q - held).cwiseAbs().maxCoeff(), 0.02);
  must(run("delete waypoint 0"));
  EXPECT_THAT(run("play waypoints loop=1").text, HasSubstr("expected two or more"));
}

TEST_F(RobotSession, GoingBackIsTheSameRunAgain) {
  record(0.1, 0.1);
  record(0.3, 0.0);
  must(run("play waypoints loop=1"));
  must(run("run 0.4"));
  const std::uint64_t there = session_.control().state_hash();
  must(run("run 0.3"));
  const long back = std::lround(0.3 / (now()->time / static_cast<double>(now()->step)));
  session_.control().step_back(back);
  session_.control().wait();
  EXPECT_EQ(session_.control().state_hash(), there);
}

// A fruit in the gripper, friction in its contacts, and the break between the two ends.
TEST(RobotRun, BackAndForwardAcrossABreakIsTheSameRun) {
  Session session(waiting());
  ASSERT_TRUE(session.files().open(source("assets/scenes/cherry_tomato_pull_aside.scene.yaml")));
  must(session.run_text("run 2.6"));
  const int contacts = session.snapshot()->report.contacts;
  EXPECT_GT(contacts, 0);
  EXPECT_EQ(contacts, static_cast<int>(session.snapshot()->contacts.size())) << "of this step";
  ASSERT_TRUE(session.snapshot()->events->empty());
  const std::uint64_t before = session.control().state_hash();
  const long start = session.snapshot()->step;
  must(session.run_text("run 0.1"));
  ASSERT_EQ(session.snapshot()->events->size(), 1u);
  const std::uint64_t after = session.control().state_hash();
  const long way = session.snapshot()->step - start;
  must(session.run_text("step back " + std::to_string(way)));
  EXPECT_TRUE(session.snapshot()->events->empty());
  EXPECT_EQ(session.control().state_hash(), before);
  must(session.run_text("step " + std::to_string(way)));
  EXPECT_EQ(session.snapshot()->events->size(), 1u);
  EXPECT_EQ(session.control().state_hash(), after);
}

}  // namespace
}  // namespace pedicel::app
