// What was changed of a scene is written into its file, which stays otherwise as it was.
#include "app/session/document/scene_save.h"

#include <gmock/gmock.h>

#include <fstream>

#include "app/session/session_files.h"
#include "app/session/session_tuning.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

const char* const scene_text = R"(format: pedicel-scene
version: 1
name: two          # of a kind
purpose: a test
see: two stems
duration: 1
dt: 0.004          # s
# how exactly it is solved
rods: {newton_iterations: 3}
plants:
  # the left one
  - {name: left, file: left.plant.yaml, set: {detach.stretch: 0.1}}  # of the paper
  - name: right    # the other
    file: right.plant.yaml
    position: [0.5, 0, 0]
ground: {height: 0}
)";

class SavedScene : public ::testing::Test {
 protected:
  SavedScene() : session(waiting()) {
    Session drawing(waiting());
    draw_plant(drawing);
    for (const char* name : {"left", "right"})
      must(drawing.files().export_plant("p", folder / (std::string(name) + ".plant.yaml")));
    std::ofstream(file) << scene_text;
    EXPECT_TRUE(session.files().open(file));
  }
  void run(const std::string& line) { must(session.run_text(line)); }
  std::string text() const { return io::read_file(file); }
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }
  /// A value of the document by its key.
  static double parameter(Session& of, const std::string& key) {
    for (const SessionParameter& one : of.tuning().parameters())
      if (one.key == key) return one.value;
    ADD_FAILURE() << "no parameter " << key;
    return 0.0;
  }

  TemporaryFolder folder;
  const std::filesystem::path file = folder / "two.scene.yaml";
  Session session;
};

TEST_F(SavedScene, NothingChangedIsNothingWritten) {
  const Result saved = session.files().save();
  must(saved);
  EXPECT_THAT(saved.text, HasSubstr("unchanged"));
  EXPECT_EQ(text(), scene_text);
  EXPECT_FALSE(std::filesystem::exists(file.string() + "~"));
}

TEST_F(SavedScene, SettingsAreWrittenWhereTheyStand) {
  run("set dt 0.002");
  run("set rods.newton_iterations 5");
  run("set plants.left.detach.stretch 0.25");
  run("set plants.right.material.density 650");
  run("set coupling.friction 0.7");
  EXPECT_TRUE(session.files().dirty());
  must(session.files().save());
  EXPECT_FALSE(session.files().dirty());
  std::string expected = with(scene_text, "dt: 0.004  ", "dt: 0.002  ");
  expected = with(expected, "newton_iterations: 3", "newton_iterations: 5");
  expected = with(expected, "detach.stretch: 0.1", "detach.stretch: 0.25");
  expected = with(expected, "[0.5, 0, 0]\n", "[0.5, 0, 0]\n    set: {material.density: 650}\n");
  EXPECT_EQ(text(), expected + "coupling: {friction: 0.7}\n");
  EXPECT_EQ(io::read_file(file.string() + "~"), scene_text) << "the one before stays";
}

TEST_F(SavedScene, ReadAnewItIsTheSame) {
  run("set plants.left.detach.bend 0.3");
  run("set rods.newton_iterations 4");
  run("move plant right 0.1,0.2,0.30000000000000004");
  must(session.files().save());
  Session other(waiting());
  ASSERT_TRUE(other.files().open(file));
  EXPECT_EQ(parameter(other, "plants.left.detach.bend"), 0.3);
  EXPECT_EQ(parameter(other, "rods.newton_iterations"), 4.0);
  EXPECT_EQ(other.document().plants[1].entry.pose.position, Vec3(0.1, 0.2, 0.1 + 0.2));
  EXPECT_EQ(other.snapshot()->plants.size(), 2u);
}

TEST_F(SavedScene, UndoneAndSavedAgainItIsTheOldOne) {
  run("set plants.right.material.density 650");
  run("set plants.left.material.density 650");
  must(session.files().save());
  EXPECT_NE(text(), scene_text);
  must(session.undo());
  must(session.undo());
  EXPECT_TRUE(session.files().dirty());
  must(session.files().save());
  EXPECT_EQ(text(), scene_text);
  ASSERT_TRUE(session.files().reload());
}

// What the file says since it was saved is no change any more; going back before it is one.
TEST_F(SavedScene, SavedSettingsAreWhatTheFilesSay) {
  const std::string key = "plants.left.detach.stretch";
  const auto of_key = [&] {
    for (const SessionParameter& one : session.tuning().parameters())
      if (one.key == key) return one;
    throw std::logic_error(key);
  };
  run("set " + key + " 0.25");
  EXPECT_TRUE(of_key().changed);
  EXPECT_EQ(of_key().initial, 0.1);
  must(session.files().save());
  EXPECT_FALSE(of_key().changed);
  EXPECT_EQ(of_key().initial, 0.25);
  run("set " + key + " 0.4");
  EXPECT_TRUE(of_key().changed);
  must(session.tuning().reset(key));
  EXPECT_EQ(of_key().value, 0.25);
  EXPECT_FALSE(of_key().changed);
  must(session.undo());
  must(session.undo());
  must(session.undo());
  EXPECT_EQ(of_key().value, 0.1);
  EXPECT_TRUE(of_key().changed) << "the file says 0.25";
  run("set rods.newton_iterations 5");
  must(session.tuning().discard());
  EXPECT_EQ(of_key().value, 0.25);
  EXPECT_EQ(parameter(session, "rods.newton_iterations"), 3.0);
  EXPECT_FALSE(session.files().dirty());
}

TEST_F(SavedScene, RecordedWaypointsAreKept) {
  const std::string arm = source("assets/robots/stalk6/stalk6.urdf").string();
  const std::string with_arm = with(scene_text, "ground:", "robot:\n  file: " + arm + "\nground:");
  std::ofstream(file) << with_arm;
  ASSERT_TRUE(session.files().open(file));
  run("add waypoint 0.5 0.1,0.2,0.30000000000000004,0,0.5,0,0,0");
  run("add waypoint 1.5 0,0,0.25,0,0.5,0,0,0");
  EXPECT_TRUE(session.files().dirty());
  must(session.files().save());
  EXPECT_FALSE(session.files().dirty());
  EXPECT_THAT(text(), HasSubstr("\n    {time: 0.5, joints: [0.1, 0.2, 0.30000000000000004, 0,"));
  Session other(waiting());
  ASSERT_TRUE(other.files().open(file));
  EXPECT_EQ(other.document().waypoints, session.document().waypoints);
  EXPECT_EQ(other.document().waypoints.size(), 2u);
  must(other.run_text("delete waypoint 0"));
  must(other.files().save());
  EXPECT_THAT(text(), HasSubstr("recorded: [\n    {time: 1.5, joints"));
  must(other.run_text("clear waypoints"));
  must(other.files().save());
  EXPECT_EQ(text(), with_arm);
}

TEST_F(SavedScene, PlantsComeAndGo) {
  run("new plant third");
  run("draw stem third s 0,0,0;0,0,0.2 0.003");
  run("move plant third -0.5,0,0");
  run("delete plant right");
  std::filesystem::create_directory(folder / "plants");
  const Result alone =
      session.files().save(folder / "plants" / "third.plant.yaml", {"third", false});
  must(alone);
  EXPECT_THAT(alone.text, HasSubstr("the plant \"third\" alone"));
  EXPECT_EQ(text(), scene_text) << "a plant's name saves a plant";
  EXPECT_TRUE(session.files().dirty());
  must(session.files().save());
  EXPECT_FALSE(session.files().dirty());
  EXPECT_THAT(text(), HasSubstr("- {name: third, file: plants/third.plant.yaml, "
                                "position: [-0.5, 0, 0]}\n"));
  EXPECT_THAT(text(), ::testing::Not(HasSubstr("right")));
  EXPECT_THAT(text(), HasSubstr("# the left one\n"));
  Session other(waiting());
  ASSERT_TRUE(other.files().open(file));
  EXPECT_EQ(other.document().plants.size(), 2u);
  EXPECT_EQ(other.document().plant("third"), session.document().plant("third"));
}

// A plant that is in the file since an earlier save is known, and goes when it is deleted, renamed
// or undone.
TEST_F(SavedScene, PlantsOfAnEarlierSaveGo) {
  const auto add = [&] {
    run("new plant third");
    run("draw stem third s 0,0,0;0,0,0.2 0.003");
    must(session.files().save());
    EXPECT_THAT(text(), HasSubstr("third"));
  };
  add();
  run("delete plant third");
  must(session.files().save());
  EXPECT_EQ(text(), scene_text);
  add();
  run("rename plant third fourth");
  must(session.files().save());
  EXPECT_THAT(text(), HasSubstr("- {name: fourth, "));
  EXPECT_THAT(text(), ::testing::Not(HasSubstr("name: third")));
  for (int i = 0; i < 3; ++i) run("undo");
  must(session.files().save());
  EXPECT_EQ(text(), scene_text);
}

// One that another program added stays where its file is written over.
TEST_F(SavedScene, PlantsOfAnotherProgramStay) {
  std::ofstream(file) << with(scene_text, "  - name: right ",
                              "  - {name: other, file: left.plant.yaml}\n  - name: right ");
  run("delete plant right");
  EXPECT_FALSE(session.files().save().ok);
  must(session.files().save({}, {"", true}));
  EXPECT_THAT(text(), HasSubstr("{name: other, file: left.plant.yaml}"));
  EXPECT_THAT(text(), ::testing::Not(HasSubstr("right")));
  must(session.files().save());
}

TEST_F(SavedScene, AnImportedPlantBecomesAFileOnceItIsEdited) {
  std::ofstream(folder / "small.mtg") << "CODE :\tFORM-A\nFEATURES:\nXX\tREAL\nMTG:\n"
                                         "ENTITY-CODE\tXX\tYY\tZZ\tTopDia\n"
                                         "/P1\n^/U1\t0\t0\t0\t200\n^<E1\t0\t0\t500\t100\n"
                                         "^<E2\t0\t0\t1000\t80\n";
  const std::string imported = with(scene_text, "file: left.plant.yaml", "mtg: small.mtg");
  std::ofstream(file) << imported;
  ASSERT_TRUE(session.files().open(file));
  run("set rods.newton_iterations 4");
  must(session.files().save());
  EXPECT_EQ(text(), with(imported, "newton_iterations: 3", "newton_iterations: 4"));
  run("set sampling left distance 0.05");
  must(session.files().save());
  EXPECT_THAT(text(), HasSubstr("- {name: left, set: {detach.stretch: 0.1}, "
                                "file: left_2.plant.yaml}  # of the paper"));
  Session other(waiting());
  ASSERT_TRUE(other.files().open(file));
  EXPECT_EQ(other.document().plant("left").distance, 0.05);
}

TEST_F(SavedScene, WhatCannotBeWrittenIsSaid) {
  run("set rods.newton_iterations 4");
  std::ofstream(file) << "format: [";
  const Result saved = session.files().save();
  EXPECT_FALSE(saved.ok);
  EXPECT_THAT(saved.text, HasSubstr("two.scene.yaml:1:"));
  EXPECT_TRUE(session.files().dirty());
}

}  // namespace
}  // namespace pedicel::app
