// Opening, saving, importing, exporting: what is written is what was drawn.
#include "app/session/session_files.h"

#include <gmock/gmock.h>

#include <fstream>

#include "engine/io/atomic_file.h"
#include "plugins/plant/plant_graph.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

plant::PlantFile read(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  const auto plant = plant::read_plant_file(path, diagnostics);
  EXPECT_TRUE(plant.has_value()) << diagnostics.text();
  return plant.value_or(plant::PlantFile{});
}

class Files : public ::testing::Test {
 protected:
  Files() : session(waiting()) {}
  TemporaryFolder folder;
  Session session;
};

TEST_F(Files, SavingAndOpeningGiveTheSamePlant) {
  draw_plant(session);
  EXPECT_TRUE(session.files().dirty());
  EXPECT_FALSE(session.files().save().ok) << "a new plant has no file yet";
  must(session.files().save(folder / "new.plant.yaml"));
  EXPECT_FALSE(session.files().dirty());
  EXPECT_EQ(read(folder / "new.plant.yaml"), session.document().plant("p"));
  Session other(waiting());
  ASSERT_TRUE(other.files().open(folder / "new.plant.yaml"));
  EXPECT_EQ(other.document().plant("p"), session.document().plant("p"));
  EXPECT_EQ(other.document().state_hash(), session.document().state_hash());
}

TEST_F(Files, TheFileBeforeStays) {
  draw_plant(session);
  const auto file = folder / "p.plant.yaml";
  must(session.files().save(file));
  const std::string before = io::read_file(file);
  must(session.run_text("set radius p stem 0.005"));
  must(session.files().save());
  EXPECT_EQ(io::read_file(file.string() + "~"), before);
  EXPECT_NE(io::read_file(file), before);
}

TEST_F(Files, UndoDoesNotForgetWhereItWasSaved) {
  draw_plant(session);
  must(session.files().save(folder / "p.plant.yaml"));
  must(session.undo());
  EXPECT_TRUE(session.files().dirty());
  EXPECT_TRUE(session.is_simulated());
  must(session.files().save());
  EXPECT_TRUE(read(folder / "p.plant.yaml").fruits.empty());
  must(session.run_text("new plant q"));
  must(session.run_text("new plant r"));
  must(session.run_text("draw stem q s 0,0,0;0,0,1 0.01"));
  must(session.run_text("draw stem r s 0,0,0;0,0,1 0.01"));
  EXPECT_THAT(session.files().save(folder / "both.plant.yaml").text,
              HasSubstr("which plant, expected plant=NAME, one of: p, q, r"));
  EXPECT_THAT(session.files().save().text, HasSubstr("expected a path *.scene.yaml"));
}

TEST_F(Files, AnEditByHandAndReload) {
  draw_plant(session);
  const auto file = folder / "p.plant.yaml";
  must(session.files().save(file));
  std::string text = io::read_file(file);
  text.replace(text.find("radius: 0.004"), 13, "radius: 0.006");
  std::ofstream(file) << text;
  ASSERT_TRUE(session.files().reload());
  EXPECT_EQ(session.document().plant("p").curves[0].radius[0], 0.006);
  must(session.undo());
  EXPECT_EQ(session.document().plant("p").curves[0].radius[0], 0.004);
}

TEST_F(Files, AFaultNamesFileAndLineAndCanBeRetried) {
  const auto file = folder / "bad.plant.yaml";
  const std::string good = io::read_file(source("plants/cherry_tomato.plant.yaml"));
  std::string bad = good;
  bad.replace(bad.find("shape: drawn"), 12, "shape: blue!");
  std::ofstream(file) << bad;
  draw_plant(session);
  EXPECT_FALSE(session.files().open(file));
  ASSERT_FALSE(session.messages().all().empty());
  EXPECT_THAT(session.messages().all().back().text, HasSubstr("bad.plant.yaml:8:8: error"));
  EXPECT_TRUE(session.messages().all().back().can_retry);
  EXPECT_EQ(session.document().plants.size(), 1u) << "what was open stays";
  std::ofstream(file) << good;
  ASSERT_TRUE(session.files().reload());
  EXPECT_EQ(session.files().path(), file);
}

// The scene's robot grips fruit_5: without it nothing can be simulated.
class Unbuildable : public ::testing::TestWithParam<bool> {};

TEST_P(Unbuildable, AnEditIsTakenBackWholeWithOneSentence) {
  SessionOptions options;
  options.waits = GetParam();
  Session session(options);
  ASSERT_TRUE(session.files().open(source("assets/scenes/cherry_tomato_pull_aside.scene.yaml")));
  session.control().wait();
  session.update();
  must(session.run_text("delete organ truss fruit_1"));
  const std::uint64_t before = session.document().state_hash();
  const std::size_t lines = session.log().size();
  const Result result = session.run_text("delete organ truss fruit_5");
  session.control().wait();
  session.update();
  session.control().wait();
  session.update();
  EXPECT_EQ(result.ok, !GetParam()) << "where commands wait it is known at once";
  ASSERT_EQ(session.messages().all().size(), 1u);
  const Message& message = session.messages().all().front();
  EXPECT_THAT(message.text, HasSubstr("delete organ: taken back, for it could not be simulated"));
  EXPECT_THAT(message.text, HasSubstr("\"truss/fruit_5\" is not there"));
  EXPECT_THAT(message.text, ::testing::Not(HasSubstr("\n")));
  EXPECT_FALSE(message.can_retry) << "no file is to be mended";
  EXPECT_EQ(session.document().state_hash(), before);
  EXPECT_TRUE(session.is_simulated());
  EXPECT_EQ(session.log().size(), lines) << "a script of it must not stop there";
  EXPECT_EQ(session.history().size(), 1u);
  EXPECT_FALSE(session.history().can_redo());
  must(session.undo());
  EXPECT_FALSE(session.files().dirty());
}

INSTANTIATE_TEST_SUITE_P(Commands, Unbuildable, ::testing::Bool(), [](const auto& one) {
  return std::string(one.param ? "ThatWait" : "ThatReturn");
});

// A drag is judged when it ends: on its way it may pass through what cannot be.
TEST_F(Files, AGestureThatCannotBeSimulatedIsTakenBackAtItsEnd) {
  ASSERT_TRUE(session.files().open(source("assets/scenes/cherry_tomato_pull_aside.scene.yaml")));
  const std::uint64_t before = session.document().state_hash();
  session.begin_gesture();
  must(session.run_text("delete organ truss fruit_1"));
  EXPECT_FALSE(session.run_text("delete organ truss fruit_5"));
  EXPECT_NE(session.document().state_hash(), before);
  session.end_gesture();
  EXPECT_EQ(session.document().state_hash(), before);
  EXPECT_FALSE(session.history().can_undo());
}

TEST_F(Files, AMendedFileTakesItsMessageAway) {
  const auto file = folder / "mended.plant.yaml";
  const std::string good = io::read_file(source("plants/cherry_tomato.plant.yaml"));
  std::ofstream(file) << "curves: 3\n";
  EXPECT_FALSE(session.files().open(file));
  EXPECT_EQ(session.messages().all().size(), 1u);
  EXPECT_FALSE(session.files().reload());
  EXPECT_EQ(session.messages().all().size(), 1u) << "the same fault stands there once";
  EXPECT_EQ(session.messages().said(), 2u) << "but it was said again";
  std::ofstream(file) << good;
  ASSERT_TRUE(session.files().reload());
  EXPECT_TRUE(session.messages().all().empty());
}

TEST_F(Files, ASceneWithItsPlantsAndRobot) {
  const auto scene = source("assets/scenes/cherry_tomato_pull_up.scene.yaml");
  ASSERT_TRUE(session.files().open(scene));
  const auto now = session.snapshot();
  ASSERT_FALSE(now->plants.empty());
  EXPECT_TRUE(now->robot.present);
  EXPECT_FALSE(session.files().dirty());
  must(session.run_text("run 0.1"));
}

TEST_F(Files, ASkeletonTableGoesOutAndComesBack) {
  draw_plant(session);
  must(session.run_text("export p " + (folder / "p.csv").string()));
  must(session.run_text("import " + (folder / "p.csv").string() + " plant=again"));
  const plant::PlantFile& back = session.document().plant("again");
  ASSERT_EQ(back.curves.size(), 2u);
  EXPECT_EQ(back.curves[0].points, session.document().plant("p").curves[0].points);
  EXPECT_NEAR(back.curves[0].radius.back(), 0.004, 1.0e-9);
  EXPECT_NEAR((back.curves[1].points.back() - Vec3(0.1, 0, 0.15)).norm(), 0.0, 1.0e-12);
  must(session.undo());
  EXPECT_EQ(session.document().plants.size(), 1u);
}

TEST_F(Files, ATableIsReadInTheUnitThatIsNamed) {
  const std::string file = (folder / "cm.csv").string();
  std::ofstream(file) << "x,y,z,parentid,vid,edgetype\n0,0,0,,1,<\n0,0,10,1,2,<\n0,0,20,2,3,<\n";
  draw_plant(session);
  must(session.run_text("import " + file + " plant=again unit=cm"));
  const auto height = [&](const char* name) {
    return session.document().plant(name).curves[0].points.back().z();
  };
  EXPECT_NEAR(height("again"), 0.2, 1.0e-12);
  EXPECT_THAT(session.messages().all().back().text,
              HasSubstr("cm.csv: notice: 0.2 m tall, 3 nodes"));
  EXPECT_THAT(session.run_text("import " + file + " plant=third unit=furlong").text,
              HasSubstr("unit furlong: expected m, cm, mm or a number of metres"));
  must(session.run_text("open " + file + " unit=0.01"));
  EXPECT_NEAR(height("cm"), 0.2, 1.0e-12);
  EXPECT_TRUE(session.files().reload());
  EXPECT_NEAR(height("cm"), 0.2, 1.0e-12);
  EXPECT_THAT(session.files().script(), HasSubstr("unit=0.01"));
}

// Branches anywhere between control points, thin stalks, smooth curves: the same plant again, but
// for what a table cannot say, and from then on the same to the last bit.
TEST_F(Files, ATableOfAPlantIsReadAsTheSamePlant) {
  ASSERT_TRUE(session.files().open(source("plants/cherry_tomato.plant.yaml")));
  const std::string name = session.document().plants[0].entry.name;
  must(
      session.run(Command("export", {{"plant", name}, {"file", (folder / "first.csv").string()}})));
  EXPECT_TRUE(io::read_file(folder / "first.csv").starts_with("x,y,z,parentid,vid,edgetype,"));
  must(session.run_text("import " + (folder / "first.csv").string() + " plant=again"));
  const plant::PlantFile &drawn = session.document().plant(name),
                         &back = session.document().plant("again");
  const auto before = plant::make_curves(drawn), after = plant::make_curves(back);
  ASSERT_EQ(after.size(), before.size());
  const auto length_near = [&](const Vec3& tip) {
    double length = 0.0, least = 1.0;
    for (const auto& curve : after)
      if ((curve.point(curve.length()) - tip).norm() < least)
        least = (curve.point(curve.length()) - tip).norm(), length = curve.length();
    EXPECT_LT(least, 1e-9);
    return length;
  };
  for (const auto& curve : before) {
    const double length = length_near(curve.point(curve.length()));
    EXPECT_NEAR(length, curve.length(), 0.002) << "a branch begins on the centre line";
  }
  double thinnest = 1.0;
  for (const plant::PlantCurve& curve : back.curves)
    thinnest = std::min(thinnest, *std::ranges::min_element(curve.radius));
  EXPECT_NEAR(thinnest, 0.001, 1e-9);
  must(session.run_text("export again " + (folder / "second.csv").string()));
  must(session.run_text("import " + (folder / "second.csv").string() + " plant=third"));
  EXPECT_EQ(session.document().plant("third").curves, session.document().plant("again").curves);
}

// Every edge of a closed surface is run through once each way, and the tubes have the volume of
// their cylinders.
TEST_F(Files, MeshesAreClosed) {
  draw_plant(session);
  must(session.run_text("export p " + (folder / "p.obj").string()));
  must(session.run_text("export p " + (folder / "p.ply").string()));
  std::ifstream obj(folder / "p.obj");
  std::vector<Vec3> points;
  std::map<std::pair<int, int>, int> edges;
  double volume = 0.0;
  int objects = 0;
  for (std::string word, line; std::getline(obj, line);) {
    std::istringstream in(line);
    in >> word;
    Vec3 p;
    if (word == "v" && in >> p.x() >> p.y() >> p.z()) points.push_back(p);
    if (word == "o") ++objects;
    if (word != "f") continue;
    std::array<int, 3> t{};
    for (int& corner : t) {
      in >> word;
      corner = std::stoi(word) - 1;
    }
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    volume += points[t[0]].cross(points[t[1]]).dot(points[t[2]]) / 6.0;
  }
  EXPECT_EQ(objects, 3);
  const double pi = 3.14159265358979;
  const double expected =
      pi * 0.004 * 0.004 * 0.3 + pi * 0.0015 * 0.0015 * 0.1013 + 4.0 / 3.0 * pi * 1.0e-6;
  EXPECT_NEAR(volume / expected, 1.0, 0.1);
  EXPECT_GT(volume, 0.0) << "inside out";
  EXPECT_THAT(io::read_file(folder / "p.ply"), HasSubstr("element face"));
  EXPECT_FALSE(session.run_text("export p " + (folder / "p.stl").string()).ok);
}

}  // namespace
}  // namespace pedicel::app
