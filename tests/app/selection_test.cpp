// What is chosen stays the same thing, whatever happens to its number.
#include "app/editors/stem_editor.h"
#include "app/ui/selection_follow.h"
#include "plugins/plant/plant_edit.h"
#include "tests/app/desk.h"

namespace pedicel::app {
namespace {

class Chosen : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.open_empty();
    for (const char* line :
         {"new plant p", "draw stem p stem 0,0,0;0,0,0.15;0,0,0.3;0,0,0.45 0.006",
          "draw stem p branch 0,0,0.2;0.08,0.0,0.26;0.16,0.0,0.28 0.003",
          "draw stem p top 0,0,0.4;-0.08,0.0,0.46;-0.16,0.0,0.48 0.003",
          "add fruit p cherry top 1 0.012 density=1000 stretch=0.05"})
      ASSERT_TRUE(desk_.session().run_text(line).ok) << line;
    desk_.settle();
    desk_.key(Key::home);
  }
  std::string chosen() { return describe(desk_.ui().selection, *desk_.snapshot()); }
  void run(const std::string& line) {
    const Result result = desk_.session().run_text(line);
    ASSERT_TRUE(result.ok) << result.text;
    desk_.settle();
  }
  void click_on_top() {
    const ImVec2 at = desk_.at(Vec3(-0.08, 0, 0.46));
    desk_.click(at.x, at.y);
    ASSERT_EQ(chosen(), "p/top");
  }
  Desk desk_;
};

TEST_F(Chosen, AStemSurvivesMirrorSamplingAndUndo) {
  click_on_top();
  run("mirror stem p branch");
  EXPECT_EQ(chosen(), "p/top");
  run("set plants.p.sampling.distance 0.005");
  EXPECT_EQ(chosen(), "p/top");
  run("set plants.p.sampling.distance 0.04");
  EXPECT_EQ(chosen(), "p/top");
  for (int i = 0; i < 3; ++i) run("undo");
  EXPECT_EQ(chosen(), "p/top");
  desk_.key(Key::del);
  desk_.settle();
  const plant::PlantFile& plant = desk_.session().document().plant("p");
  EXPECT_LT(plant.curve_index("top"), 0) << "Del takes what was chosen";
  EXPECT_GE(plant.curve_index("branch"), 0);
}

TEST_F(Chosen, AFruitSurvivesANewOneBeforeIt) {
  const auto f = follow_selection({}, *desk_.snapshot(), *desk_.snapshot());
  EXPECT_FALSE(f);
  choose_fruit(desk_.ui(), "p", "cherry");
  ASSERT_EQ(chosen(), "p/cherry");
  run("add fruit p another branch 1 0.012");
  run("mirror stem p branch");
  EXPECT_EQ(chosen(), "p/cherry");
}

TEST_F(Chosen, WhatIsDeletedIsChosenNoMore) {
  click_on_top();
  run("delete stem p top");
  EXPECT_FALSE(desk_.ui().selection);
}

TEST_F(Chosen, AFruitThatComesOffIsTheBodyThatItBecame) {
  choose_fruit(desk_.ui(), "p", "cherry");
  run("set plants.p.detach.stretch 1e-6");
  for (int i = 0; i < 40 && desk_.ui().selection.kind == Selection::Kind::fruit; ++i)
    run("run 0.05");
  ASSERT_EQ(desk_.ui().selection.kind, Selection::Kind::body);
  EXPECT_EQ(chosen(), "p/cherry");
  run("step back");
  run("reset");
  EXPECT_EQ(desk_.ui().selection.kind, Selection::Kind::fruit);
  EXPECT_EQ(chosen(), "p/cherry");
}

// Chosen in the tree or in the scene: the same elements are drawn in another colour.
TEST_F(Chosen, AStemOfTheTreeIsTheSameOrganAsInTheScene) {
  click_on_top();
  const auto& model = *desk_.snapshot()->plants[0].model;
  const int organ = chosen_organ(desk_.ui().selection, model, 0);
  EXPECT_GE(organ, 0);
  choose_curve(desk_.ui(), "p", "top");
  EXPECT_EQ(chosen_organ(desk_.ui().selection, model, 0), organ);
  desk_.frames(2);
  const render::Image chosen_one = desk_.picture();
  desk_.ui().selection = {};
  desk_.frames(2);
  const render::Image plain = desk_.picture();
  const ImVec2 at = desk_.at(Vec3(-0.08, 0, 0.46));
  long changed = 0;
  for (int y = static_cast<int>(at.y) - 8; y < at.y + 8; ++y)
    for (int x = static_cast<int>(at.x) - 8; x < at.x + 8; ++x)
      changed += std::abs(chosen_one.at(x, y)[0] - plain.at(x, y)[0]) > 20;
  EXPECT_GT(changed, 3) << "the stem chosen in the tree looks as before";
}

}  // namespace
}  // namespace pedicel::app
