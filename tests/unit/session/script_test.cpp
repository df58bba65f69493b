// Scripts: the whole story of a user, and what a script is told when it goes wrong.
#include "app/session/script.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/session/session_files.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

const char* const story = R"(# draw a stem and a branch, add a fruit
new plant p
draw stem p stem 0,0,0;0,0,0.15;0,0,0.3 0.004
draw stem p branch 0,0,0.15;0.05,0,0.16;0.1,0,0.15 0.0015
add fruit p berry branch 1 0.01 force=2
expect stems is=2
run 0.5
expect breaks is=0
# play, pull it off
pull p/berry 0.4,0,0.1
run 1
expect breaks is=1
expect time_s is=1.5
release
# undo takes the pull back, then the fruit away, and the plant starts anew
undo
expect fruits is=1
undo
expect fruits is=0
expect time_s is=0
redo
expect fruits is=1
save SAVED
run 0.1
reload
expect fruits is=1
expect stems is=2
expect time_s is=0
)";

class Scripts : public ::testing::Test {
 protected:
  Scripts() : session(waiting()) {}
  int run(const std::string& text) {
    std::ofstream(folder / "story.txt") << text;
    out.str("");
    errors.str("");
    return run_script(folder / "story.txt", session, out, errors);
  }
  void open_robot() {
    ASSERT_TRUE(session.files().open(source("assets/scenes/cherry_tomato_pull_up.scene.yaml")));
  }
  TemporaryFolder folder;
  Session session;
  std::ostringstream out, errors;
};

TEST_F(Scripts, TheWholeStory) {
  std::string text = story;
  text.replace(text.find("SAVED"), 5, (folder / "mine.plant.yaml").string());
  EXPECT_EQ(run(text), 0) << errors.str();
  EXPECT_TRUE(std::filesystem::exists(folder / "mine.plant.yaml"));
  EXPECT_THAT(out.str(), HasSubstr("breaks is 1"));
}

TEST_F(Scripts, TheSameTwiceIsTheSame) {
  std::string text = story;
  text = text.substr(0, text.find("release"));
  ASSERT_EQ(run(text), 0) << errors.str();
  const std::uint64_t hash = session.control().state_hash();
  Session again(waiting());
  std::ostringstream ignored;
  ASSERT_EQ(run_script(folder / "story.txt", again, ignored, ignored), 0);
  EXPECT_EQ(again.control().state_hash(), hash);
}

TEST_F(Scripts, TheLogIsAScriptThatDoesTheSame) {
  draw_plant(session);
  session.begin_gesture();
  must(session.run_text("smooth points p branch 0.3"));
  must(session.run_text("smooth points p branch 0.6"));
  session.end_gesture();
  must(session.run_text("delete organ p berry"));
  must(session.undo());
  std::string text;
  for (const std::string& line : session.log()) text += line + "\n";
  const std::uint64_t hash = session.document().state_hash();
  session.files().open_empty();
  ASSERT_EQ(run(text), 0) << errors.str();
  EXPECT_EQ(session.document().state_hash(), hash);
}

TEST_F(Scripts, WhatIsExpectedIsThatOfTheStepThatIsShown) {
  open_robot();
  ASSERT_EQ(run("run 0.5\n"), 0) << errors.str();
  const auto heights = session.control().log().series("tool_x_m");
  ASSERT_GT(heights.value.size(), 40U);
  ASSERT_EQ(run("step back 60\nexpect time_s above=0.2499 below=0.2501\n"), 0) << errors.str();
  const auto row = std::upper_bound(heights.time.begin(), heights.time.end(), 0.25 + 1e-9) - 1;
  const double then = heights.value[static_cast<std::size_t>(row - heights.time.begin())];
  ASSERT_NE(then, heights.value.back()) << "it moves";
  EXPECT_EQ(run("expect tool_x_m is=" + io::exact_number(then) + "\n"), 0) << errors.str();
}

TEST_F(Scripts, FaultsNameTheirLine) {
  EXPECT_EQ(run("new plant p\n\ndraw sten p\n"), 3);
  EXPECT_THAT(errors.str(), HasSubstr("story.txt:3:1: error: unknown command \"draw\""));
  EXPECT_EQ(run("new plant q\ndelete stem q s\n"), 1);
  EXPECT_THAT(errors.str(), HasSubstr("story.txt:2:1: error: delete stem: no stem \"s\""));
  EXPECT_EQ(run("expect breaks is=7\n"), 5);
  EXPECT_THAT(errors.str(), HasSubstr("breaks is 0, not as expected"));
  EXPECT_EQ(run("open /nowhere/x.scene.yaml\n"), 3);
  EXPECT_THAT(errors.str(), HasSubstr("/nowhere/x.scene.yaml"));
  EXPECT_EQ(run("pull p/nothing 0,0,0\n"), 1);
  EXPECT_EQ(run("joint wrist 1\n"), 1);
  EXPECT_THAT(errors.str(), HasSubstr("the scene has no robot"));
  EXPECT_THROW(run_script(folder / "none", session, out, errors), InvalidFile);
}

TEST_F(Scripts, TheRobotGoesWhereItIsSent) {
  const std::string scene = source("assets/scenes/cherry_tomato_pull_up.scene.yaml").string();
  ASSERT_EQ(run("open " + scene + "\nrun 0.02\n"), 0) << errors.str();
  const Vec3 before = session.snapshot()->robot.tool.position;
  ASSERT_EQ(run("jog -0.02,0,0.01\nrun 1.5\n"), 0) << errors.str();
  const Vec3 moved = session.snapshot()->robot.tool.position - before;
  EXPECT_NEAR((moved - Vec3(-0.02, 0, 0.01)).norm(), 0.0, 2.0e-3) << moved.transpose();
  EXPECT_EQ(run("tool 9,9,9\n"), 1);
  EXPECT_THAT(errors.str(), HasSubstr("unreachable"));
}

TEST_F(Scripts, ATrajectoryIsPlayed) {
  const std::string scene = source("assets/scenes/cherry_tomato_pull_up.scene.yaml").string();
  ASSERT_EQ(run("open " + scene + "\nrun 0.1\n"), 0) << errors.str();
  const auto now = session.snapshot();
  const std::string joint = robot::KinematicModel(*now->assets->robot).joint_names()[0];
  const double from = now->robot.q[0], to = from + 0.1;
  std::ofstream(folder / "move.csv")
      << "time_s," << joint << "\n0," << from << "\n0.5," << to << "\n";
  const std::string file = (folder / "move.csv").string();
  ASSERT_EQ(run("play trajectory " + file + "\nrun 1\n"), 0) << errors.str();
  EXPECT_NEAR(session.snapshot()->robot.q[0], to, 5.0e-3);
  std::ofstream(folder / "move.csv") << "time_s,elbow_of_nobody\n0,0\n";
  EXPECT_EQ(run("play trajectory " + file + "\n"), 3);
  EXPECT_THAT(errors.str(), HasSubstr("move.csv:1:8"));
}

TEST_F(Scripts, WaypointsArePlayed) {
  const std::string scene = source("assets/scenes/cherry_tomato_pull_up.scene.yaml").string();
  ASSERT_EQ(run("open " + scene + "\n"), 0) << errors.str();
  Eigen::VectorXd q = session.snapshot()->robot.q;
  q[0] += 0.1;
  must(session.run(
      Command("add waypoint",
              {{"time", 0.5}, {"joints", std::vector<double>(q.data(), q.data() + q.size())}})));
  ASSERT_EQ(run("play waypoints\nrun 1\n"), 0) << errors.str();
  EXPECT_NEAR(session.snapshot()->robot.q[0], q[0], 5.0e-3);
  must(session.undo());
  EXPECT_EQ(run("play waypoints\n"), 1);
}

TEST_F(Scripts, WhatCannotBeDoneIsNotTakenSilently) {
  open_robot();
  const std::string joint =
      robot::KinematicModel(*session.snapshot()->assets->robot).joint_names()[0];
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"run -1", "duration -1, expected a number between 0 and 1000000 (s, simulated)"},
      {"run 1e300", "duration 1e+300, expected a number between 0 and 1000000 (s, simulated)"},
      {"speed -2", "value -2, expected a number >= 0 (simulated s a wall s"},
      {"step 0", "count 0, expected a number >= 1 (steps"},
      {"step back -3", "count -3, expected a number >= 1 (steps"},
      {"step back 5", "5 from step 0, expected a run that has begun"},
      {"step 2\nstep back 3", "3 from step 2, expected at most as many as were done"},
      {"joint " + joint + " 99", "joint " + joint + " = 99, expected -"},
      {"gripper 9", " = 9, expected "}};
  for (const auto& [line, words] : refused) {
    errors.str("");
    EXPECT_EQ(run("reset\n" + line + "\n"), 1) << line;
    EXPECT_THAT(errors.str(), HasSubstr(words)) << line;
  }
}

TEST_F(Scripts, AFaultIsCalledErrorOnceAndInTheCommandsOwnWords) {
  std::ofstream(folder / "bad.plant.yaml") << "curves: 3\n";
  EXPECT_EQ(run("open " + (folder / "bad.plant.yaml").string() + "\n"), 3);
  const std::string said = errors.str();
  EXPECT_EQ(said.find("error:"), said.rfind("error:")) << said;
  EXPECT_THAT(said, HasSubstr("story.txt:1:1: error: "));
  EXPECT_EQ(run("set nosuch 3\n"), 1);
  EXPECT_THAT(errors.str(), HasSubstr("nosuch"));
  EXPECT_EQ(errors.str().find("--set"), std::string::npos) << errors.str();
}

TEST_F(Scripts, AFileWithAFaultIsInvalid) {
  open_robot();
  EXPECT_EQ(run("play trajectory " + (folder / "none.csv").string() + "\n"), 3);
  EXPECT_EQ(run("load waypoints " + (folder / "none.csv").string() + "\n"), 3);
  std::ofstream(folder / "experiment.yaml") << "format: pedicel-experiment\nversion: 9\n";
  EXPECT_EQ(run("open experiment " + (folder / "").string() + "\n"), 3) << errors.str();
  EXPECT_EQ(run("joint nobody 1\n"), 1);
}

// What was done, as a script, does the same again: document and run.
TEST(SavedScript, DoesTheSameAgain) {
  TemporaryFolder folder;
  Session session(waiting());
  draw_plant(session);
  must(session.run_text("move point p branch 2 0.12,0,0.14"));
  must(session.undo());
  must(session.run_text("set plants.p.material.density 650"));
  must(session.run_text("run 0.1"));
  must(session.run_text("pull p/berry 0.12,0.02,0.15"));
  must(session.run_text("run 0.1"));
  std::ofstream(folder / "again.script") << "dear";
  must(session.run_text("save script " + (folder / "again.script").string()));
  EXPECT_EQ(io::read_file(folder / "again.script~"), "dear") << "what was there is kept";
  Session other(waiting());
  std::ostringstream out, errors;
  EXPECT_EQ(run_script(folder / "again.script", other, out, errors), 0) << errors.str();
  EXPECT_EQ(other.document().state_hash(), session.document().state_hash());
  EXPECT_EQ(other.control().state_hash(), session.control().state_hash());
}

void expect_replay(const TemporaryFolder& folder, Session& session) {
  must(session.run_text("save script " + (folder / "replay.script").string()));
  Session other(waiting());
  std::ostringstream out, errors;
  EXPECT_EQ(run_script(folder / "replay.script", other, out, errors), 0) << errors.str();
  EXPECT_EQ(other.document().plants.size(), session.document().plants.size());
  for (const DocumentPlant& one : session.document().plants)
    EXPECT_EQ(other.document().plant(one.entry.name), *one.file);
  EXPECT_EQ(other.control().state_hash(), session.control().state_hash());
}

TEST(SavedScript, BeginsWithWhatWasThereBeforeASave) {
  TemporaryFolder folder;
  Session session(waiting());
  draw_plant(session);
  must(session.files().save(folder / "new.plant.yaml"));
  must(session.run_text("move point p branch 2 0.12,0,0.14"));
  must(session.run_text("run 0.1"));
  expect_replay(folder, session);  // a new plant
  must(session.run_text("open " + (folder / "new.plant.yaml").string()));
  must(session.run_text("draw stem p second 0,0,0.2;0.1,0.05,0.25 0.002"));
  must(session.files().save());
  must(session.run_text("delete organ p berry"));
  must(session.run_text("run 0.1"));
  expect_replay(folder, session);  // one that was saved over
}

TEST(SavedScript, OfASceneThatWasSavedOver) {
  TemporaryFolder folder;
  std::filesystem::copy_file(source("plants/cherry_tomato.plant.yaml"),
                             folder / "truss.plant.yaml");
  const auto scene = folder / "s.scene.yaml";
  std::ofstream(scene) << "format: pedicel-scene\nversion: 1\npurpose: a\nsee: b\nduration: 1\n"
                          "ground: {height: 0}\nplants:\n"
                          "  - {name: truss, file: truss.plant.yaml}\n";
  Session session(waiting());
  ASSERT_TRUE(session.files().open(scene)) << session.messages().all().back().text;
  must(session.run_text("set dt 0.004"));
  must(session.run_text("set plants.truss.detach.stretch 0.2"));
  must(session.run_text("new plant p"));
  must(session.run_text("draw stem p stem 0.3,0,0;0.3,0,0.2 0.003"));
  must(session.files().save(folder / "p.plant.yaml"));
  must(session.files().save());
  must(session.run_text("unset dt"));
  must(session.run_text("run 0.1"));
  const double dt = session.snapshot()->assets->scene.dt;
  expect_replay(folder, session);
  EXPECT_NE(dt, 0.004);
}

TEST(SavedScript, ReadsTheFilesAnewWhereThatWasDone) {
  TemporaryFolder folder;
  std::filesystem::copy_file(source("plants/cherry_tomato.plant.yaml"), folder / "p.plant.yaml");
  Session session(waiting());
  ASSERT_TRUE(session.files().open(folder / "p.plant.yaml"))
      << session.messages().all().back().text;
  const std::string plant = session.document().plants.front().entry.name;
  must(session.run_text("draw stem \"" + plant + "\" more 0,0,0.2;0.1,0.05,0.25 0.002"));
  must(session.run_text("reload"));
  must(session.run_text("run 0.1"));
  EXPECT_EQ(session.document().plants.front().file->curve_index("more"), -1);
  expect_replay(folder, session);
  must(session.undo());
  EXPECT_NE(session.document().plants.front().file->curve_index("more"), -1);
  expect_replay(folder, session);
}

// A stroke that makes a plant is two commands and one step.
TEST(SavedScript, HasAWholeGestureUndone) {
  TemporaryFolder folder;
  Session session(waiting());
  draw_plant(session);
  session.begin_gesture();
  must(session.run_text("new plant q"));
  must(session.run_text("draw stem q stem 0.3,0,0;0.3,0,0.2 0.003"));
  session.end_gesture();
  must(session.undo());
  expect_replay(folder, session);
}

}  // namespace
}  // namespace pedicel::app
