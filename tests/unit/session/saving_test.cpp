// Saving writes what was meant and nothing else: the open scene, its plants and files that were
// there stay as they are.
#include <gmock/gmock.h>

#include <fstream>

#include "app/session/session_files.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const herb_text = R"(# measured in May
format: pedicel-plant
version: 1
name: herb     # a herb
material: {youngs_modulus: 2.0e+8, poisson_ratio: 0.35, density: 800, damping_time: 0.02}
sampling: {connect: 0.01, distance: 0.02}
root: [0, 0, 0]
curves:
  # the stem
  - name: stem
    points:
      - [0, 0, 0]      # the foot
      - [0, 0, 0.15]
      - [0, 0, 0.3]
    radius: &thin 0.004
  - {name: twig, points: [[0, 0, 0.15], [0.1, 0, 0.2]], radius: *thin}   # thin
)";

const char* const herb_scene = R"(format: pedicel-scene
version: 1
name: one          # of a kind
purpose: a test
see: a stem
duration: 1
plants:
  - {name: herb, file: herb.plant.yaml}   # the only one
ground: {height: 0}
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

class Saving : public ::testing::Test {
 protected:
  Saving() : session(waiting()) {
    std::ofstream(plant) << herb_text;
    std::ofstream(scene) << herb_scene;
  }
  void open(const std::filesystem::path& file) { ASSERT_TRUE(session.files().open(file)); }
  void run(const std::string& line) { must(session.run_text(line)); }
  static std::string text(const std::filesystem::path& file) { return io::read_file(file); }
  static bool there(const std::filesystem::path& file) { return std::filesystem::exists(file); }

  TemporaryFolder folder;
  const std::filesystem::path plant = folder / "herb.plant.yaml";
  const std::filesystem::path scene = folder / "one.scene.yaml";
  const std::filesystem::path other = folder / "other.scene.yaml";
  Session session;
};

// --- names ---

TEST_F(Saving, ASceneNameReceivesTheScene) {
  open(scene);
  run("set dt 0.002");
  run("set radius herb stem 0.005");
  must(session.files().save(other));
  EXPECT_EQ(text(scene), herb_scene) << "the one that was open stays as it was";
  EXPECT_EQ(text(plant), herb_text) << "and its plant";
  EXPECT_FALSE(there(scene.string() + "~"));
  EXPECT_EQ(session.files().path(), other);
  EXPECT_FALSE(session.files().dirty());
  EXPECT_THAT(text(other), HasSubstr("name: one          # of a kind"));
  EXPECT_THAT(text(other), HasSubstr("dt: 0.002"));
  EXPECT_THAT(text(other), HasSubstr("file: herb_2.plant.yaml}   # the only one"));
  EXPECT_THAT(text(folder / "herb_2.plant.yaml"), HasSubstr("# measured in May"));
  Session again(waiting());
  ASSERT_TRUE(again.files().open(other));
  EXPECT_EQ(again.document().plant("herb"), session.document().plant("herb"));
  run("set dt 0.001");
  must(session.files().save());
  EXPECT_EQ(text(scene), herb_scene);
  EXPECT_THAT(text(other), HasSubstr("dt: 0.001"));
}

TEST_F(Saving, ASceneInAnotherFolderFindsItsPlants) {
  open(scene);
  std::filesystem::create_directory(folder / "deep");
  must(session.files().save(folder / "deep" / "one.scene.yaml"));
  EXPECT_THAT(text(folder / "deep" / "one.scene.yaml"), HasSubstr("file: ../herb.plant.yaml}"));
  Session again(waiting());
  ASSERT_TRUE(again.files().open(folder / "deep" / "one.scene.yaml"));
  EXPECT_EQ(again.document().plants.size(), 1u);
}

TEST_F(Saving, APlantNameReceivesThePlantAlone) {
  open(scene);
  run("set radius herb stem 0.005");
  run("set dt 0.002");
  const auto copy = folder / "copy.plant.yaml";
  const Result saved = session.files().save(copy);
  must(saved);
  EXPECT_THAT(saved.text, HasSubstr("the plant \"herb\" alone"));
  EXPECT_EQ(text(scene), herb_scene);
  EXPECT_EQ(text(plant), herb_text);
  EXPECT_EQ(session.files().path(), scene);
  EXPECT_TRUE(session.files().dirty()) << "the scene is not saved by this";
  EXPECT_THAT(text(copy), HasSubstr("# the stem"));
  must(session.files().save());
  EXPECT_THAT(text(scene), HasSubstr("file: herb.plant.yaml}")) << "it does not point at the copy";
}

TEST_F(Saving, OfSeveralPlantsTheOneThatIsNamed) {
  open(scene);
  run("copy plant herb second position=0.5,0,0");
  EXPECT_THAT(session.files().save(folder / "x.plant.yaml").text,
              HasSubstr("one of: herb, second"));
  EXPECT_FALSE(there(folder / "x.plant.yaml"));
  run("set radius second stem 0.006");
  run("save " + (folder / "x.plant.yaml").string() + " plant=second");
  Diagnostics diagnostics;
  const auto read = plant::read_plant_file(folder / "x.plant.yaml", diagnostics);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, session.document().plant("second"));
}

TEST_F(Saving, OtherNamesAreRefused) {
  open(scene);
  for (const char* name : {"x.csv", "x.obj", "x"}) {
    const Result saved = session.run_text("save " + (folder / name).string());
    EXPECT_FALSE(saved.ok);
    EXPECT_THAT(saved.text, HasSubstr("expected *.scene.yaml for the scene or *.plant.yaml"));
    EXPECT_FALSE(there(folder / name));
  }
}

TEST_F(Saving, ANewSceneIsSavedWithItsPlants) {
  draw_plant(session);
  EXPECT_TRUE(session.files().needs_name());
  EXPECT_EQ(session.files().suggested_name().filename(), "p.scene.yaml");
  run("save " + (folder / "new.scene.yaml").string());
  EXPECT_TRUE(there(folder / "p.plant.yaml"));
  EXPECT_FALSE(session.files().dirty());
  EXPECT_FALSE(session.files().needs_name());
  Session again(waiting());
  ASSERT_TRUE(again.files().open(folder / "new.scene.yaml"));
  EXPECT_EQ(again.document().state_hash(), session.document().state_hash());
}

TEST_F(Saving, TwoPlantsOfOneFilePartWhenOneIsChanged) {
  open(scene);
  run("copy plant herb second position=0.5,0,0");
  must(session.files().save());
  EXPECT_THAT(text(scene), HasSubstr("{name: second, file: herb.plant.yaml, position"));
  run("set radius second stem 0.006");
  must(session.files().save());
  EXPECT_EQ(text(plant), herb_text) << "the first one's";
  EXPECT_THAT(text(scene), HasSubstr("second, file: second.plant.yaml"));
}

// --- files that are there ---

TEST_F(Saving, AFileThatIsThereIsNotWrittenOverUnasked) {
  open(scene);
  std::ofstream(other) << "precious";
  const auto precious = folder / "precious.plant.yaml";
  std::ofstream(precious) << "precious";
  for (const auto& file : {other, precious}) {
    const Result saved = session.files().save(file);
    EXPECT_FALSE(saved.ok);
    EXPECT_TRUE(saved.overwrites);
    EXPECT_THAT(saved.text, HasSubstr("is there already, expected a new name, or overwrite=1"));
    EXPECT_EQ(text(file), "precious");
    run("save " + file.string() + " overwrite=1");
    EXPECT_NE(text(file), "precious");
    EXPECT_EQ(text(file.string() + "~"), "precious");
  }
}

TEST_F(Saving, WhatAnotherProgramChangedIsNotWrittenOverUnasked) {
  open(scene);
  run("set radius herb twig 0.001");
  const std::string theirs = with(herb_text, "density: 800", "density: 650");
  std::ofstream(plant) << theirs;
  const Result saved = session.files().save();
  EXPECT_FALSE(saved.ok);
  EXPECT_TRUE(saved.overwrites);
  EXPECT_THAT(saved.text, HasSubstr("herb.plant.yaml was changed by another program"));
  EXPECT_EQ(text(plant), theirs);
  EXPECT_TRUE(session.files().dirty());
  run("save overwrite=1");
  EXPECT_THAT(text(plant), HasSubstr("density: 800"));
  EXPECT_EQ(text(plant.string() + "~"), theirs);
  run("set radius herb twig 0.002");
  must(session.files().save());  // what it wrote itself is known
}

TEST_F(Saving, TheSceneFileToo) {
  open(scene);
  run("set dt 0.002");
  const std::string theirs = with(herb_scene, "duration: 1", "duration: 2");
  std::ofstream(scene) << theirs;
  EXPECT_TRUE(session.files().save().overwrites);
  EXPECT_EQ(text(scene), theirs);
  must(session.files().save({}, {{}, true}));
  EXPECT_THAT(text(scene), HasSubstr("dt: 0.002"));
  EXPECT_THAT(text(scene), HasSubstr("duration: 1"));
}

TEST_F(Saving, CommentsOfAnotherProgramStay) {
  open(scene);
  run("set radius herb twig 0.001");
  std::ofstream(plant) << with(herb_text, "# the stem", "# the stem, as Ann says");
  must(session.files().save());
  EXPECT_THAT(text(plant), HasSubstr("# the stem, as Ann says"));
}

// --- comments, anchors, layout ---

TEST_F(Saving, OnlyWhatChangedIsWritten) {
  open(plant);
  run("move point herb twig 1 0.12,0,0.2");
  must(session.files().save());
  EXPECT_EQ(text(plant), with(herb_text, "[0.1, 0, 0.2]", "[0.12, 0, 0.2]"));
  run("undo");
  must(session.files().save());
  EXPECT_EQ(text(plant), herb_text);
}

TEST_F(Saving, AnAnchorKeepsWhatOthersHaveOfIt) {
  open(plant);
  run("set radius herb stem 0.005");
  must(session.files().save());
  EXPECT_EQ(text(plant), with(with(herb_text, "&thin 0.004", "&thin 0.005"), "*thin}", "0.004}"));
}

TEST_F(Saving, OrgansComeAndGoInTheirFile) {
  open(plant);
  run("add fruit herb berry twig 1 0.01 force=2");
  must(session.files().save());
  EXPECT_EQ(text(plant), herb_text + std::string("fruits:\n  - {name: berry, curve: twig, at: 1, "
                                                 "radius: 0.01, density: 950, detach: {force: "
                                                 "2}}\n"));
  run("delete stem herb twig");
  must(session.files().save());
  std::string expected = herb_text;
  expected.erase(expected.find("  - {name: twig"));
  EXPECT_EQ(text(plant), expected);
}

TEST_F(Saving, NumbersAreThoseOfEveryYamlReader) {
  open(plant);
  run("set material herb youngs_modulus 3e9");
  run("set material herb damping_time 0.00001");
  must(session.files().save());
  EXPECT_THAT(text(plant), HasSubstr("youngs_modulus: 3.0e+9"));
  EXPECT_THAT(text(plant), HasSubstr("damping_time: 1.0e-5"));
}

// --- what is not saved stays unsaved ---

TEST_F(Saving, WhatCannotBeOpenedLeavesTheEditsUnsaved) {
  open(scene);
  run("set dt 0.002");
  EXPECT_FALSE(session.files().open(folder / "nothing.scene.yaml"));
  EXPECT_TRUE(session.files().dirty());
}

TEST_F(Saving, AScriptAfterSaveAsDoesTheSame) {
  open(scene);
  run("set radius herb stem 0.005");
  must(session.files().save(other));
  run("set radius herb stem 0.006");
  must(session.files().save());
  run("save script " + (folder / "again.script").string());
  Session again(waiting());
  std::ifstream script(folder / "again.script");
  for (std::string line; std::getline(script, line);)
    if (!line.empty() && line.front() != '#') must(again.run_text(line));
  EXPECT_EQ(again.document().plant("herb"), session.document().plant("herb"));
}

}  // namespace
}  // namespace pedicel::app
