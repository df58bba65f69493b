// A scene is built from nothing by commands, saved, and read again as the same one.
#include <gmock/gmock.h>

#include <fstream>

#include "app/session/commands/scene_things.h"
#include "app/session/session_files.h"
#include "app/session/session_recovery.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/edit_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string stalk6 = "assets/robots/stalk6/stalk6.urdf";

class Building : public ::testing::Test {
 protected:
  Building() : session(waiting()) {}
  void run(const std::string& line) { must(session.run_text(line)); }
  std::string refusal(const std::string& line) {
    const std::uint64_t before = session.document().state_hash();
    const Result result = session.run_text(line);
    EXPECT_FALSE(result.ok) << line;
    EXPECT_EQ(session.document().state_hash(), before);
    return result.text;
  }
  const world::Scene& scene() const { return *session.document().scene; }
  void build() {
    for (const char* line : draw_lines) run(line);
    run("add robot " + source(stalk6).string() + " name=arm");
    run("add box table size=0.3,0.2,0.1 position=-0.4,0,0.05 look=wood turn=0,0,0.3");
    run("add sphere ball 0.03 mass=0.1 position=-0.4,0,0.2");
    run("add cylinder post 0.02 0.5 position=-0.6,0,0.25");
    run("add capsule rod 0.02 0.3 position=-0.6,0.2,0.3 turn=0.1,0.2,0.3");
    run("add tray tray 0.24,0.2,0.06 0.006 position=0.2,0.5,0");
    run("add camera front 1,-1,0.7 0,0,0.3 fov=0.6");
    run("set ground friction=0.7");
    run("copy plant p q position=0,0.4,0");
    run("turn plant q 0,0,1.2");
  }
  static std::uint64_t hash_after(Session& of, int steps) {
    must(of.run_text("reset"));
    must(of.run_text("step " + std::to_string(steps)));
    return of.control().state_hash();
  }

  TemporaryFolder folder;
  Session session;
};

TEST_F(Building, WhatIsBuiltIsSimulated) {
  build();
  const auto now = session.snapshot();
  EXPECT_EQ(now->plants.size(), 2u);
  EXPECT_EQ(now->bodies.size(), 5u);
  EXPECT_TRUE(now->robot.present);
  EXPECT_TRUE(session.is_simulated());
}

// What is added while the simulation runs begins it anew: with the old one it would not be there.
TEST_F(Building, WhatIsAddedToARunIsInIt) {
  for (const char* line : draw_lines) run(line);
  const auto bodies = [&] { return session.snapshot()->bodies.size(); };
  run("run 0.1");
  run("add sphere ball 0.03 mass=0.1 position=-0.4,0,0.2");
  EXPECT_EQ(bodies(), 1u);
  run("run 0.1");
  run("move body ball -0.4,0,0.5");
  EXPECT_EQ(session.snapshot()->time, 0.0);
  run("run 0.1");
  run("add robot stalk6");
  EXPECT_TRUE(session.snapshot()->robot.present);
  run("run 0.1");
  run("add camera front 1,-1,0.7 0,0,0.3");
  EXPECT_GT(session.snapshot()->time, 0.0) << "a camera changes nothing of it";
}

TEST_F(Building, SavedAndReadAgainItIsTheSame) {
  build();
  const auto file = folder / "built.scene.yaml";
  must(session.files().save(file));
  EXPECT_FALSE(session.files().dirty());
  Session again(waiting());
  ASSERT_TRUE(again.files().open(file));
  EXPECT_EQ(again.document().state_hash(), session.document().state_hash());
  EXPECT_EQ(hash_after(again, 100), hash_after(session, 100));
  const std::string text = io::read_file(file);
  must(again.files().save());
  EXPECT_EQ(io::read_file(file), text);
  const std::vector<std::string> keys = {
      "\nplants:", "\nrobot:", "\nbodies:", "\nground:", "\ncameras:"};
  std::size_t last = 0;
  for (const std::string& key : keys) {
    EXPECT_GT(text.find(key), last) << key;
    last = text.find(key);
  }
  EXPECT_THAT(text, HasSubstr("\n  - {name: ball, sphere: {radius: 0.03}, mass: 0.1, position: "
                              "[-0.4, 0, 0.2]}\n"));
}

TEST_F(Building, EveryCommandIsUndoneAndRedone) {
  build();
  const std::uint64_t built = session.document().state_hash();
  std::vector<std::uint64_t> hashes = {built};
  while (session.history().can_undo()) {
    must(session.undo());
    hashes.push_back(session.document().state_hash());
  }
  EXPECT_FALSE(session.files().dirty());
  for (std::size_t i = hashes.size() - 1; i > 0; --i) {
    EXPECT_NE(hashes[i], hashes[i - 1]) << "a step that changed nothing";
    must(session.redo());
    EXPECT_EQ(session.document().state_hash(), hashes[i - 1]);
  }
}

TEST_F(Building, AScriptOfItDoesItAgain) {
  build();
  must(session.run_text("save script " + (folder / "built.script").string()));
  Session again(waiting());
  std::ifstream script(folder / "built.script");
  for (std::string line; std::getline(script, line);)
    if (!line.empty() && line.front() != '#') must(again.run_text(line));
  EXPECT_EQ(again.document().state_hash(), session.document().state_hash());
}

TEST_F(Building, AKilledProgramLeavesIt) {
  SessionOptions options = waiting();
  options.autosave = folder / "autosave";
  std::uint64_t built = 0;
  {
    Session lost(options);
    must(lost.run_text("add sphere ball 0.03"));
    must(lost.run_text("add robot " + source(stalk6).string()));
    built = lost.document().state_hash();
  }
  Session found(options);
  ASSERT_EQ(found.recovery().lost_documents().size(), 1u);
  ASSERT_TRUE(found.recovery().recover(found.recovery().lost_documents()[0]));
  EXPECT_EQ(found.document().state_hash(), built);
  EXPECT_TRUE(found.messages().all().empty());
}

TEST_F(Building, ThingsAreMovedTurnedCopiedRenamedDeleted) {
  build();
  run("move body table 1,2,3");
  EXPECT_EQ(scene().bodies[0].pose.position, Vec3(1, 2, 3));
  run("turn body table 0,0,0,1");
  EXPECT_TRUE(scene().bodies[0].pose.rotation.isApprox(Quat::Identity()));
  run("copy body table second position=1,0,0");
  EXPECT_EQ(scene().bodies.back().name, "second");
  EXPECT_EQ(scene().bodies.back().parts.front().half_extents,
            scene().bodies[0].parts.front().half_extents);
  run("rename body second third");
  run("set body third size_x 0.5");
  EXPECT_EQ(scene().bodies.back().parts.front().half_extents.x(), 0.25);
  run("set body tray wall 0.004");
  run("set body ball mass 0.2");
  run("set look ball accent");
  run("delete body third");
  EXPECT_EQ(scene().bodies.size(), 5u);
  run("move camera front 2,0,1 0,0,0");
  run("copy camera front back");
  run("rename camera back rear");
  run("delete camera front");
  EXPECT_EQ(scene().cameras.size(), 1u);
  run("rename plant q herb");
  run("delete plant herb");
  EXPECT_EQ(session.document().plants.size(), 1u);
  run("move robot 0.5,0,0.1");
  run("turn robot 0,0,3.1");
  run("rename robot lite");
  EXPECT_EQ(scene().robot->name, "lite");
  run("delete robot");
  run("delete ground");
  EXPECT_FALSE(scene().ground);
  run("set ground height=-0.1");
  EXPECT_EQ(scene().ground->height, -0.1);
}

TEST_F(Building, WhatCannotBeIsRefusedWithASentence) {
  build();
  EXPECT_THAT(refusal("add box table 1,1,1"), HasSubstr("a body \"table\" is there already"));
  EXPECT_THAT(refusal("add box a/b 1,1,1"), HasSubstr("expected one without / and ."));
  EXPECT_THAT(refusal("add box b 1,0,1"), HasSubstr("size 0, expected a number > 0"));
  EXPECT_THAT(refusal("add sphere b -1"), HasSubstr("radius -1, expected a number > 0"));
  EXPECT_THAT(refusal("add sphere b 1e300"), HasSubstr("at most 10000000"));
  EXPECT_THAT(refusal("add box b 1,1e300,1"), HasSubstr("at most 10000000"));
  EXPECT_THAT(refusal("add sphere b 1 mass=1e300"),
              HasSubstr("expected a number between 0 and 1e+09 (kg"));
  EXPECT_THAT(refusal("add sphere b 1 position=1e300,0,0"),
              HasSubstr("position 1e+300, expected a number"));
  EXPECT_THAT(refusal("set ground height=1e300"), HasSubstr("height 1e+300, expected a number"));
  EXPECT_THAT(refusal("set ground restitution=1.2"),
              HasSubstr("restitution 1.2, expected a number between 0 and 1"));
  EXPECT_THAT(refusal("set body ball mass 1e300"),
              HasSubstr("expected a number between 0 and 1e+09 (kg"));
  EXPECT_THAT(refusal("set body ball radius 1e300"), HasSubstr("at most 10000000"));
  EXPECT_THAT(refusal("add sphere b 1 look=gold"), HasSubstr("expected one of: steel, wood"));
  EXPECT_THAT(refusal("add sphere b 1 turn=0,0"), HasSubstr("expected x,y,z,w or roll,pitch,yaw"));
  EXPECT_THAT(refusal("add tray b 0.1,0.1,0.1 0.05"), HasSubstr("wall, expected m below half"));
  EXPECT_THAT(refusal("set body ball wall 1"), HasSubstr("an extent that it has"));
  EXPECT_THAT(refusal("set body ball mass -1"), HasSubstr("mass -1, expected a number between 0"));
  EXPECT_THAT(refusal("move body none 0,0,0"), HasSubstr("expected one of: table, ball"));
  EXPECT_THAT(refusal("move camera front 0,0,0 0,0,0"), HasSubstr("expected them to be apart"));
  EXPECT_THAT(refusal("add robot " + source(stalk6).string()),
              HasSubstr("\"arm\" is there already"));
  EXPECT_THAT(refusal("rename plant q p"), HasSubstr("a plant \"p\" is there already"));
  EXPECT_THAT(refusal("set robot tool nowhere"), HasSubstr("no link \"nowhere\""));
  run("delete robot");
  EXPECT_THAT(refusal("delete robot"), HasSubstr("the scene has no robot"));
  EXPECT_THAT(refusal("add robot /none.urdf"), HasSubstr("none.urdf"));
}

// An added arm is of use where it stands: its tool comes to the fruit.
TEST_F(Building, AnAddedArmReachesTheFruit) {
  for (const double x : {0.0, 2.0}) {
    session.files().open_empty();
    for (const char* line : draw_lines) run(line);
    run("move plant p " + std::to_string(x) + ",1,0");
    run("add robot " + source(stalk6).string());
    const world::SceneRobot& robot = *scene().robot;
    EXPECT_EQ(robot.tool, "tool");
    EXPECT_EQ(robot.gripper, "finger_joint");
    EXPECT_GT((robot.base.position - Vec3(x, 1, 0)).head<2>().norm(), 0.2) << "not in the plant";
    must(session.run_text("tool " + std::to_string(x + 0.1) + ",1,0.15"));
  }
}

// --- what the scene says of a thing ---

class Spoken : public Building {
 protected:
  Spoken() {
    EXPECT_TRUE(session.files().open(source("assets/scenes/cherry_tomato_pull_aside.scene.yaml")));
  }
};

TEST_F(Spoken, AThingThatIsMeantIsDeletedAfterWhatMeansIt) {
  EXPECT_THAT(refusal("delete plant truss"),
              HasSubstr("is meant by the robot's program, 4 expectations, expected \"clear "
                        "references truss\" before"));
  EXPECT_THAT(refusal("delete body tray"), HasSubstr("1 expectation"));
  run("clear references truss");
  EXPECT_TRUE(scene().robot->waypoints.empty());
  run("delete plant truss");
  must(session.undo());
  must(session.undo());
  EXPECT_FALSE(session.files().dirty());
  EXPECT_EQ(scene().robot->waypoints.size(), 6u);
}

TEST_F(Spoken, AProgramIsClearedAndThenItsStemGoes) {
  const Result taken_back = session.run_text("delete organ truss fruit_5");
  EXPECT_FALSE(taken_back.ok);
  EXPECT_THAT(taken_back.text, HasSubstr("clear references truss/fruit_5"));
  run("clear program");
  run("clear references truss/fruit_5");
  run("delete organ truss fruit_5");
}

/// Tied to wires, with a shoot that the arm is to cut.
class Tied : public Building {
 protected:
  Tied() { EXPECT_TRUE(session.files().open(source("assets/scenes/espalier_prune.scene.yaml"))); }
};

TEST_F(Tied, TiesAndCutsFollowANewName) {
  run("rename tree arm_right_1 bough");
  run("rename tree shoot_1 spur");
  run("rename plant tree pear");
  EXPECT_TRUE(session.is_simulated());
  EXPECT_EQ(scene().ties[0].organ, "pear/bough");
  EXPECT_EQ(scene().ties[1].organ, "pear/arm_left_1");
  EXPECT_EQ(scene().cuts[0].organ, "pear/spur");
}

TEST_F(Tied, WhatTiesAndCutsMeanIsDeletedAfterThem) {
  EXPECT_THAT(refusal("delete robot"), HasSubstr("1 cut"));
  const Result taken_back = session.run_text("delete stem tree arm_right_1");
  EXPECT_FALSE(taken_back.ok);
  EXPECT_THAT(taken_back.text, HasSubstr("clear references tree/arm_right_1"));
  run("clear references robot");
  run("delete robot");
  EXPECT_TRUE(scene().cuts.empty());
  EXPECT_THAT(refusal("delete plant tree"), HasSubstr("4 ties"));
  run("clear references tree");
  run("delete plant tree");
  EXPECT_TRUE(scene().ties.empty());
}

TEST_F(Spoken, ANewNameIsSaidEverywhere) {
  run("set plants.truss.detach.stretch 0.2");
  run("rename plant truss cherry");
  run("rename body tray box");
  run("rename camera front view");
  EXPECT_TRUE(session.is_simulated());
  EXPECT_EQ(scene().robot->waypoints[0].at.name, "cherry/fruit_5");
  EXPECT_EQ(scene().expectations[3].body, "box");
  EXPECT_EQ(scene().video.camera, "view");
  EXPECT_EQ(session.document().settings[0].first, "plants.cherry.detach.stretch");
  must(session.files().save(folder / "renamed.scene.yaml"));
  const std::string text = io::read_file(folder / "renamed.scene.yaml");
  EXPECT_THAT(text, Not(HasSubstr("truss/")));
  EXPECT_THAT(text, HasSubstr("facing: {approach: [-1, 0, 0], across: [0, 1, 0]}"))
      << "the rest is as it was written";
  Session again(waiting());
  ASSERT_TRUE(again.files().open(folder / "renamed.scene.yaml"));
  EXPECT_EQ(hash_after(again, 20), hash_after(session, 20));
}

// --- turns ---

TEST(Turns, AreReadAsFilesReadThem) {
  const Quat yaw = read_turn({0, 0, 1.5707963267948966});
  EXPECT_TRUE((yaw * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-12));
  const Quat rolled = read_turn({0.4, 0, 0.9});  // first about X
  EXPECT_TRUE((rolled * Vec3::UnitX()).isApprox(Vec3(std::cos(0.9), std::sin(0.9), 0), 1e-12));
  for (int i = 1; i < 200; ++i) {
    const Quat turn = read_turn({0.01 * i, 0.02 * i, -0.03 * i});
    EXPECT_EQ(turn.normalized().coeffs(), turn.coeffs()) << i;
  }
  EXPECT_THROW(read_turn({0, 0, 0, 0}), UsageError);
}

TEST(Names, OfCopiesAreFree) {
  Document document = empty_document();
  EXPECT_EQ(free_name(document, ThingKind::body, "box"), "box");
  for (const char* name : {"box", "box_2"}) {
    world::BodyDescription body;
    body.name = name;
    document.edit_scene().bodies.push_back(body);
  }
  EXPECT_EQ(free_name(document, ThingKind::body, "box"), "box_3");
  EXPECT_EQ(free_name(document, ThingKind::body, "box_2"), "box_3");
}

}  // namespace
}  // namespace pedicel::app
