// What the panels say of the chosen thing, of the world and of what happened, and what they do.
#include "app/editors/stem_editor.h"
#include "app/panels/time_line.h"
#include "app/session/session_robot.h"
#include "app/ui/selection_follow.h"
#include "engine/io/atomic_file.h"
#include "tests/app/desk.h"
#include "tests/app/words.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Inspector : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.draw_coarsely();
    desk_.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
    plant_ = desk_.session().document().plants.front().entry.name;
    fruit_ = desk_.session().document().plants.front().file->fruits[4].name;
  }
  void run(const std::string& line) {
    const Result result = desk_.session().run_text(line);
    ASSERT_TRUE(result.ok) << result.text;
    desk_.settle();
  }
  void press(const std::string& dock, const std::string& words) {
    const auto at = place_of(dock, words);
    ASSERT_TRUE(at) << "\"" << words << "\" is not to be seen";
    desk_.click(at->x, at->y);
    desk_.settle();
  }
  Desk desk_;
  std::string plant_, fruit_;
};

TEST_F(Inspector, SaysTheTunedThreshold) {
  desk_.show("Plants");
  choose_fruit(desk_.ui(), plant_, fruit_);
  desk_.frames(4);
  EXPECT_FALSE(place_of("left", "tuned for the whole plant"));
  run("set plants." + plant_ + ".detach.stretch 0.4321");
  desk_.frames(4);
  EXPECT_TRUE(place_of("left", "tuned for the whole plant"));
  EXPECT_TRUE(place_of("left", "0.4321"));
}

// A pick or waypoints of a window are programs, too, and a scene may have none.
TEST_F(Inspector, TheProgramIsNotSaidToBeTheScenes) {
  desk_.show("Robot");
  desk_.frames(4);
  EXPECT_TRUE(place_of("right", "Follows a program."));
  EXPECT_FALSE(place_of("right", "scene's program"));
}

TEST_F(Inspector, SaysWhereItIsAndLeadsTheToolThere) {
  desk_.show("Plants");
  run("stop robot");
  choose_fruit(desk_.ui(), plant_, fruit_);
  desk_.frames(4);
  EXPECT_TRUE(place_of("left", "In the world, mm"));
  press("left", "Tool to selection");
  const auto place = place_of(desk_.ui().selection, *desk_.snapshot());
  ASSERT_TRUE(place);
  EXPECT_NEAR((desk_.session().robot().tool_goal()->asked_W.position - *place).norm(), 0.0, 0.002);
}

TEST_F(Inspector, TheWorldHasGravityAndASolver) {
  desk_.show("World");
  press("right", "Moon");
  EXPECT_EQ(desk_.snapshot()->assets->scene.gravity, Vec3(0, 0, -1.62));
  press("right", "backward euler");
  EXPECT_EQ(desk_.snapshot()->assets->rods.integrator, cosserat::Integrator::backward_euler);
  EXPECT_EQ(desk_.session().history().size(), 2u);
}

TEST_F(Inspector, ABreakIsToldMarkedAndGoneTo) {
  run("stop robot");
  desk_.ui().notice.clear();
  run("set plants." + plant_ + ".detach.stretch 1e-6");
  for (int i = 0; i < 20 && desk_.snapshot()->events->empty(); ++i) run("run 0.05");
  ASSERT_FALSE(desk_.snapshot()->events->empty());
  EXPECT_THAT(desk_.ui().notice, HasSubstr("came off at"));
  const world::Event first = desk_.snapshot()->events->front();
  run("run 1");
  EXPECT_EQ(desk_.ui().view.seen.events->size(), desk_.snapshot()->events->size());
  desk_.show("Events");
  const double late = desk_.snapshot()->time;
  press("bottom", first.organ);
  EXPECT_LT(desk_.snapshot()->time, late);
  EXPECT_TRUE(desk_.ui().selection);
  EXPECT_GE(desk_.ui().view.seen.until, late) << "the line of time knows how far it was";
}

TEST_F(Inspector, AClickOnTheLineOfTimeGoesThere) {
  run("stop robot");
  run("run 2");
  const LayoutAreas areas{
      desk_.desktop().scene().frame().low,
      ImVec2(desk_.desktop().scene().frame().low.x + desk_.desktop().scene().frame().size.x,
             desk_.desktop().scene().frame().low.y + desk_.desktop().scene().frame().size.y)};
  const double middle = 0.5 * (areas.scene_min.x + areas.scene_max.x);
  desk_.click(middle, areas.scene_max.y + 0.5 * time_line_height(desk_.ui()));
  desk_.settle();
  EXPECT_NEAR(desk_.snapshot()->time, 1.0, 0.05);
}

TEST_F(Inspector, AFaultOfAnImportStaysWholeInMessages) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "faulty.csv";
  io::write_file_atomically(file, "x,y\n1,2\n");
  desk_.ui().import_plant(file);
  desk_.frames(3);
  ASSERT_FALSE(desk_.session().messages().all().empty());
  EXPECT_THAT(desk_.session().messages().all().back().text, HasSubstr("faulty.csv"));
  EXPECT_FALSE(desk_.ui().notice.empty());
}

TEST_F(Inspector, AnImportedPlantIsFramed) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "far.plant.yaml";
  io::write_file_atomically(file,
                            io::read_file(scene_file("../../plants/cherry_tomato.plant.yaml")));
  desk_.desktop().scene().camera().look_at(Vec3(5, 5, 0));
  desk_.ui().import_plant(file);
  desk_.settle();
  const PlantSnapshot& plant = desk_.snapshot()->plants.back();
  const ImVec2 at = desk_.at(plant.state.position[0]);
  const SceneFrame& scene = desk_.desktop().scene().frame();
  EXPECT_GT(at.x, scene.low.x);
  EXPECT_LT(at.x, scene.low.x + scene.size.x);
  EXPECT_TRUE(desk_.ui().frame_plant.empty());
}

TEST_F(Inspector, BackspaceLeavesTheRobotInTheHand) {
  run("jog 0,0,0.02");
  desk_.key(Key::backspace);
  desk_.settle();
  EXPECT_EQ(desk_.snapshot()->step, 0);
  EXPECT_FALSE(desk_.snapshot()->robot.follows_program);
}

TEST_F(Inspector, TheEyeStaysAboveTheGround) {
  const SceneFrame& scene = desk_.desktop().scene().frame();
  const ImVec2 from(scene.low.x + 30, scene.low.y + 0.8f * scene.size.y);
  desk_.drag({from, ImVec2(from.x, from.y - 200), ImVec2(from.x, from.y - 400)});
  EXPECT_GT(desk_.desktop().scene().camera().camera().eye.z(), 0.0);
}

// Two sidebars would leave the scene nothing.
TEST(Narrow, OneSidebarGivesWay) {
  Desk desk(640, 480);
  if (!desk.available()) GTEST_SKIP() << desk.why();
  desk.draw_coarsely();
  desk.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  EXPECT_GT(desk.desktop().scene().frame().size.x, 0.5f * 640);
  desk.show("View");
  EXPECT_TRUE(desk.ui().preferences.show_right);
  EXPECT_FALSE(desk.ui().preferences.show_left);
  desk.show("Plants");
  EXPECT_FALSE(desk.ui().preferences.show_right);
}

}  // namespace
}  // namespace pedicel::app
