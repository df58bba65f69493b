// Undo of pulls, times to go to, numbers that are tuned, gravity, waypoints one by one.
#include <gmock/gmock.h>

#include <fstream>

#include "app/session/document/effective_plant.h"
#include "app/session/live/robot_goal.h"
#include "app/session/session_files.h"
#include "app/session/session_robot.h"
#include "engine/io/atomic_file.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Hands : public ::testing::Test {
 protected:
  Hands() : session(waiting()) { draw_plant(session); }
  void run(const std::string& line) { must(session.run_text(line)); }
  std::string refusal(const std::string& line) {
    const Result result = session.run_text(line);
    EXPECT_FALSE(result.ok) << "taken: " << line;
    return result.text;
  }
  Vec3 tip() {
    const auto now = session.snapshot();
    return now->plants[0].state.position.back();
  }
  Session session;
};

TEST_F(Hands, UndoTakesAPullBackBeforeTheEditThatCameEarlier) {
  run("run 0.1");
  const long step = session.snapshot()->step;
  const std::uint64_t plain = session.control().state_hash();
  const std::size_t edits = session.history().size();
  run("pull p/berry 0.3,0,0.3");
  run("run 0.2");
  run("release");
  EXPECT_TRUE(session.can_undo());
  run("undo");
  EXPECT_EQ(session.snapshot()->step, step);
  EXPECT_EQ(session.control().state_hash(), plain) << "the run is where the pull began, bit by bit";
  EXPECT_EQ(session.history().size(), edits) << "no edit was taken back";
  run("run 0.2");
  EXPECT_FALSE(session.snapshot()->pull.active) << "it is not pulled again";
  Session untouched(waiting());
  draw_plant(untouched);
  must(untouched.run_text("run 0.1"));
  must(untouched.run_text("run 0.2"));
  EXPECT_EQ(session.control().state_hash(), untouched.control().state_hash());
  run("undo");
  EXPECT_EQ(session.history().size(), edits - 1) << "now the edit";
}

TEST_F(Hands, ACutFallsIsToldAndIsTakenBack) {
  run("run 0.1");
  const std::uint64_t whole = session.control().state_hash();
  run("cut p/branch 0.3");
  run("run 0.1");
  auto now = session.snapshot();
  ASSERT_EQ(now->events->size(), 1u);
  EXPECT_EQ(now->events->front().cause, "cut");
  EXPECT_EQ(now->events->front().organ, "p/branch");
  ASSERT_EQ(now->bodies.size(), 1u) << "branch and berry fall as one";
  EXPECT_LT(now->bodies[0].pose.position.z(), 0.15);
  EXPECT_THAT(refusal("cut p/branch 0.6"), HasSubstr("has come off there already"));
  EXPECT_THAT(refusal("cut p/twig"), HasSubstr("no organ"));
  EXPECT_THAT(refusal("cut p/stem 1.5"), HasSubstr("between 0 and 1"));
  run("step back 12");
  run("step 12");
  EXPECT_EQ(session.snapshot()->bodies[0].pose.position, now->bodies[0].pose.position)
      << "stepping back and on cuts again";
  run("undo");
  now = session.snapshot();
  EXPECT_EQ(session.control().state_hash(), whole);
  EXPECT_TRUE(now->events->empty());
  run("run 0.05");
  EXPECT_TRUE(session.snapshot()->events->empty()) << "it is not cut again";
}

TEST_F(Hands, AnEditAfterAPullIsUndoneFirst) {
  run("pull p/berry 0.15,0,0.2");
  run("run 0.05");
  run("release");
  run("set rods.newton_iterations 7");
  const std::size_t edits = session.history().size();
  run("undo");
  EXPECT_EQ(session.history().size(), edits - 1);
  EXPECT_GT(session.snapshot()->step, 0);
  run("undo");
  EXPECT_EQ(session.snapshot()->step, 0) << "the pull";
}

TEST_F(Hands, ATimeIsGoneToBackAndForth) {
  run("run 0.2");
  const std::uint64_t late = session.control().state_hash();
  run("go to 0.05");
  EXPECT_EQ(session.snapshot()->step, std::lround(0.05 * 240));
  run("go to 0.2");
  EXPECT_EQ(session.control().state_hash(), late);
  EXPECT_THAT(refusal("go to -1"), HasSubstr("between 0 and"));
}

TEST_F(Hands, ATunedNumberActsAndIsKeptAlone) {
  run("set organ p berry stretch 0.2");
  run("set plants.p.detach.stretch 0.4");
  run("set plants.p.material.density 700");
  const Document& document = session.document();
  EXPECT_EQ(document.plant("p").fruits[0].detach.stretch, 0.2) << "the file";
  EXPECT_EQ(effective_plant(document, "p").fruits[0].detach.stretch, 0.4) << "what acts";
  const PlantSetting who = who_sets(document, "p", "detach.stretch");
  EXPECT_EQ(who.by, SetBy::session);
  EXPECT_EQ(who_sets(document, "p", "detach.force").by, SetBy::file);
  run("keep setting " + who.key);
  EXPECT_EQ(session.document().plant("p").fruits[0].detach.stretch, 0.4);
  EXPECT_EQ(who_sets(session.document(), "p", "detach.stretch").by, SetBy::file);
  EXPECT_EQ(who_sets(session.document(), "p", "material.density").by, SetBy::session);
  EXPECT_THAT(refusal("keep setting plants.p.detach.stretch"), HasSubstr("as the files say"));
  run("set rods.newton_iterations 7");
  EXPECT_THAT(refusal("keep setting rods.newton_iterations"), HasSubstr("belongs to the scene"));
}

TEST_F(Hands, GravityIsASetting) {
  run("set gravity 0,0,0");
  EXPECT_TRUE(session.snapshot()->assets->scene.gravity.isZero());
  run("run 0.1");
  EXPECT_LT(session.snapshot()->largest_strain, 0.05);
  run("set gravity \"[0, 1.5, -1.62]\"");
  EXPECT_EQ(session.snapshot()->assets->scene.gravity, Vec3(0, 1.5, -1.62));
  EXPECT_THAT(refusal("set gravity 0,0"), HasSubstr("must be x,y,z"));
  EXPECT_THAT(refusal("set gravity 0,0,101"), HasSubstr("-100 and 100"));
  run("undo");
  run("undo");
  EXPECT_EQ(session.snapshot()->assets->scene.gravity, Vec3(0, 0, -9.81));
}

TEST_F(Hands, WaypointsOneByOne) {
  run("add waypoint 1 0.1,0.2");
  run("add waypoint 2 0.3,0.4");
  run("add waypoint 3 0.5,0.6");
  const auto pose = [&](std::size_t i) { return session.document().waypoints[i].joints[0]; };
  run("set waypoint 0 time=2.5");
  EXPECT_EQ(session.document().waypoints[1].time, 2.5);
  EXPECT_EQ(pose(1), 0.1);
  run("set waypoint 2 joints=7,8");
  EXPECT_EQ(pose(2), 7.0);
  run("move waypoint 2 0");
  EXPECT_EQ(pose(0), 7.0);
  EXPECT_EQ(pose(1), 0.3);
  EXPECT_EQ(session.document().waypoints[0].time, 2.0) << "the times stay";
  EXPECT_THAT(refusal("set waypoint 0 time=2.5"), HasSubstr("at that time already"));
  EXPECT_THAT(refusal("set waypoint 0 joints=1"), HasSubstr("expected 2"));
  EXPECT_THAT(refusal("move waypoint 0 3"), HasSubstr("expected one of 3"));
}

TEST(Robot, AWideTurnDoesNotFlipTheArm) {
  Session session(waiting());
  must(session.run_text("open " +
                        source("assets/scenes/cherry_tomato_pull_aside.scene.yaml").string()));
  must(session.run_text("stop robot"));
  ASSERT_TRUE(session.snapshot()->robot.present);
  const Pose tool = session.robot().tool_goal()->nearest_W;
  const Eigen::VectorXd before = session.snapshot()->robot.q;
  // A ring is dragged by 120 degrees about the tool's own axis.
  Pose turned = tool;
  turned.rotation =
      (tool.rotation * Eigen::AngleAxisd(2.0 * M_PI / 3.0, Vec3::UnitZ())).normalized();
  const robot::IkResult found = session.robot().reach(turned);
  if (!found.reached) GTEST_SKIP() << found.sentence;
  double most = 0.0;
  for (int i = 0; i < before.size(); ++i) most = std::max(most, std::abs(found.q[i] - before[i]));
  EXPECT_LT(most, 2.0 * M_PI / 3.0 + 0.4)
      << "no joint turns more than the ring: " << found.q.transpose();
}

TEST(Robot, HomeIsWhereItStarts) {
  Session session(waiting());
  must(session.run_text("open " +
                        source("assets/scenes/cherry_tomato_pull_aside.scene.yaml").string()));
  EXPECT_FALSE(session.robot().is_led());
  must(session.run_text("jog 0,0,0.02"));
  EXPECT_TRUE(session.robot().is_led());
  must(session.run_text("home robot"));
  const auto& joints = session.snapshot()->assets->scene.robot->joints;
  const auto now = session.snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  for (const auto& [name, value] : joints) {
    const int joint = model.joint_index(name);
    if (joint < 0) continue;
    EXPECT_NEAR(now->robot.goal[joint], value, 1e-9) << name;
  }
  must(session.run_text("reset"));
  EXPECT_FALSE(session.robot().is_led());
}

// A bar that lies at height 0 lies on the ground; a stem that stands in it leaves it where it is.
TEST(Opened, ABarLiesOnTheGround) {
  const auto open = [](const std::string& curves) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "lies.plant.yaml";
    io::write_file_atomically(
        file,
        "format: pedicel-plant\nversion: 1\nname: bar\nshape: drawn\n"
        "material: {youngs_modulus: 2.0e+9, poisson_ratio: 0.3, density: 1000, damping_time: "
        "0.01}\n"
        "sampling: {connect: 0.01, distance: 0.02}\nroot: [0, 0, 0]\ncurves:\n" +
            curves);
    Session session(waiting());
    EXPECT_TRUE(session.files().open(file)) << session.messages().all().back().text;
    return session.document().scene->ground->height;
  };
  EXPECT_NEAR(open("  - {name: bar, points: [[0, 0, 0], [0.3, 0, 0]], section: {kind: rectangle, "
                   "width: 0.02, height: 0.006, normal: [0, 0, 1]}}\n"),
              -0.003, 1e-12);
  EXPECT_EQ(open("  - {name: bar, points: [[0, 0, 0], [0, 0, 0.3]], radius: 0.004}\n"), 0.0);
}

}  // namespace
}  // namespace pedicel::app
