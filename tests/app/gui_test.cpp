// The window's habits, by real input events off screen.
#include <chrono>
#include <thread>

#include "core/check.h"
#include "desk.h"
#include "words.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Gui : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.ui().view.automatic_quality = false;
    desk_.ui().view.quality = CanvasQuality::coarsest;
    desk_.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  }
  Vec3 fruit_place(int fruit) {
    const auto snapshot = desk_.snapshot();
    const PlantSnapshot& plant = snapshot->plants[0];
    const cosserat::Fruit& one = plant.model->fruits[static_cast<std::size_t>(fruit)];
    return point_on(*plant.model, plant.state, one.element, one.back);
  }
  static constexpr double free_x = 330, free_y = 600;  // px, only ground there

  Desk desk_;
};

TEST_F(Gui, SpacePlaysAndPauses) {
  EXPECT_EQ(desk_.snapshot()->mode, RunMode::paused);
  desk_.key(Key::space);
  desk_.settle();  // a window that stands still draws faster than the simulation answers
  EXPECT_EQ(desk_.snapshot()->mode, RunMode::playing);
  for (int i = 0; i < 400 && desk_.snapshot()->step == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    desk_.frames(1);
  }
  desk_.key(Key::space);
  desk_.settle();
  EXPECT_EQ(desk_.snapshot()->mode, RunMode::paused);
  EXPECT_GT(desk_.snapshot()->step, 0);
}

TEST_F(Gui, StepsForwardAndBack) {
  desk_.key(Key::right);
  desk_.key(Key::period);
  desk_.settle();
  EXPECT_EQ(desk_.snapshot()->step, 2);
  desk_.key(Key::left);
  desk_.settle();
  EXPECT_EQ(desk_.snapshot()->step, 1);
  desk_.key(Key::backspace);
  desk_.settle();
  EXPECT_EQ(desk_.snapshot()->step, 0);
}

TEST_F(Gui, DragsTurnPanAndDolly) {
  const ViewCamera start = desk_.desktop().camera();
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y + 20)});
  EXPECT_EQ(desk_.desktop().camera().target(), start.target());
  EXPECT_FALSE(desk_.desktop().camera() == start) << "a left drag turns";
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y)}, 1);
  EXPECT_GT((desk_.desktop().camera().target() - start.target()).norm(), 0.01)
      << "a right drag moves";
  const double before = desk_.desktop().camera().distance();
  desk_.move(free_x, free_y);
  desk_.wheel(2);
  EXPECT_LT(desk_.desktop().camera().distance(), before);
}

TEST_F(Gui, BlenderPresetTurnsWithTheMiddleButton) {
  desk_.ui().preferences.mouse = MousePreset::blender;
  const ViewCamera start = desk_.desktop().camera();
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y + 20)});
  EXPECT_TRUE(desk_.desktop().camera() == start);
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y + 20)}, 2);
  EXPECT_FALSE(desk_.desktop().camera() == start);
}

TEST_F(Gui, AClickChoosesAFruitAndEscLetsGo) {
  const ImVec2 at = desk_.at(fruit_place(4));
  desk_.click(at.x, at.y);
  EXPECT_EQ(describe(desk_.ui().selection, *desk_.snapshot()), "truss/fruit_5");
  desk_.key(Key::escape);
  EXPECT_FALSE(desk_.ui().selection);
}

TEST_F(Gui, CtrlDragPullsWithTheForceOfTheSpring) {
  const ImVec2 at = desk_.at(fruit_place(4));
  desk_.move(at.x, at.y);
  ASSERT_TRUE(desk_.ui().hover) << "nothing under the pointer";
  desk_.hold(Key::left_control, true);
  desk_.button(0, true);
  desk_.move(at.x - 60, at.y + 10);
  desk_.session().control().run_for(0.2);
  desk_.settle();
  const auto snapshot = desk_.snapshot();
  ASSERT_TRUE(snapshot->pull.active);
  const double stretch = (snapshot->pull.target_W - snapshot->pull.point_W).norm();
  EXPECT_NEAR(snapshot->pull.force_W.norm(), 50.0 * stretch, 0.05 * 50.0 * stretch);
  EXPECT_GT(snapshot->pull.force_W.norm(), 0.05);
  desk_.button(0, false);
  desk_.hold(Key::left_control, false);
  desk_.settle();
  EXPECT_FALSE(desk_.snapshot()->pull.active);
}

TEST_F(Gui, APlainDragNeverPulls) {
  const ImVec2 at = desk_.at(fruit_place(4));
  desk_.move(at.x, at.y);
  desk_.button(0, true);
  desk_.move(at.x - 50, at.y);
  desk_.settle();
  EXPECT_FALSE(desk_.snapshot()->pull.active);
  desk_.button(0, false);
}

TEST_F(Gui, ASliderChangesTheRunningPlantAndUndoTakesItBack) {
  desk_.show("Tune");
  const auto before = desk_.session().parameters();
  desk_.key(Key::right);  // not at time 0: a restart would show
  desk_.settle();
  // The first slider of the panel: below search, buttons, the group's heading and its name.
  const ImGuiWindow* panel = nullptr;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->WasActive && std::string(window->Name).find("parameters") != std::string::npos)
      panel = window;
  ASSERT_NE(panel, nullptr);
  std::string changed;
  const float left = panel->InnerRect.Min.x + 20, right = panel->InnerRect.Max.x - 30;
  for (float y = panel->InnerRect.Min.y + 30; changed.empty() && y < panel->InnerRect.Max.y - 40;
       y += 9) {
    desk_.drag({ImVec2(left, y), ImVec2(0.5f * (left + right), y), ImVec2(right, y)});
    for (const SessionParameter& p : desk_.session().parameters())
      if (p.changed) changed = p.key;
  }
  desk_.frames(5);
  ASSERT_FALSE(changed.empty()) << "no slider was found";
  EXPECT_EQ(desk_.session().history().size(), 1u)
      << "one drag is one step of the history " << changed << " " << desk_.ui().notice;
  desk_.key(Key::z, true);
  const auto after = desk_.session().parameters();
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].value, before[i].value);
}

TEST_F(Gui, KeysAreLettersWhileATextIsTyped) {
  desk_.show("Messages");
  const ImGuiWindow* panel = panel_window("bottom", "Messages");
  ASSERT_NE(panel, nullptr);
  desk_.click(panel->InnerRect.Min.x + 60, panel->InnerRect.Max.y - 14);
  desk_.hold(Key::space, true);
  desk_.type(" ");
  desk_.hold(Key::space, false);
  EXPECT_NE(desk_.snapshot()->mode, RunMode::playing);
  desk_.type("step count=3");
  desk_.key(Key::enter);
  desk_.settle();
  EXPECT_EQ(desk_.snapshot()->step, 3);
}

TEST_F(Gui, AFileThatCannotBeReadIsShownAndRetried) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "broken.plant.yaml";
  std::ofstream(path) << "format: pedicel-plant\nversion: 1\nnonsense: 3\n";
  desk_.drop(path.string());
  desk_.frames(3);
  EXPECT_EQ(desk_.ui().dialog, Dialog::problem);
  EXPECT_THAT(desk_.ui().problem, HasSubstr("broken.plant.yaml:3"));
  EXPECT_FALSE(desk_.snapshot()->plants.empty()) << "what was open stays";
  std::filesystem::copy_file(
      std::filesystem::path(PEDICEL_SOURCE_DIR) / "plants" / "young_plant.plant.yaml", path,
      std::filesystem::copy_options::overwrite_existing);
  desk_.key(Key::escape);
  desk_.key(Key::r, true);
  desk_.settle();
  EXPECT_EQ(desk_.session().path(), path);
}

TEST_F(Gui, RobotSliderMovesTheJoint) {
  desk_.show("Robot");
  const double before = desk_.snapshot()->robot.goal[0];
  const ImGuiWindow* panel = panel_window("right", "Robot");
  ASSERT_NE(panel, nullptr);
  const float left = panel->InnerRect.Min.x + 30, right = panel->InnerRect.Max.x - 60;
  for (float y = panel->InnerRect.Min.y + 40; y < panel->InnerRect.Min.y + 130; y += 9)
    desk_.drag({ImVec2(left, y), ImVec2(right, y)});
  desk_.settle();
  EXPECT_GT(std::abs(desk_.snapshot()->robot.goal[0] - before), 0.05);
}

TEST_F(Gui, AFilmOfTheWindowIsBegunAndEndedByItsButton) {
  const auto before = std::filesystem::current_path();
  const auto folder = std::filesystem::path(::testing::TempDir()) / "window_film";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  desk_.show("View");
  const auto begin = place_of("right", "Record a film");
  ASSERT_TRUE(begin);
  desk_.click(begin->x, begin->y);
  EXPECT_TRUE(desk_.ui().recording);
  EXPECT_FALSE(desk_.session().run_text("record other.mp4").ok) << "one at a time";
  desk_.frames(10);
  const auto end = place_of("right", "End the film");
  ASSERT_TRUE(end);
  desk_.click(end->x, end->y);
  std::filesystem::current_path(before);
  EXPECT_FALSE(desk_.ui().recording);
  const bool film = std::filesystem::exists(folder / "pedicel_001.mp4") ||
                    std::filesystem::exists(folder / "pedicel_001_frames/frame_00000.png");
  EXPECT_TRUE(film) << desk_.ui().notice;
}

TEST_F(Gui, TabHidesThePanelsAndTheSceneGrows) {
  const float before = desk_.desktop().scene().size.x;
  desk_.key(Key::tab);
  EXPECT_GT(desk_.desktop().scene().size.x, before + 300);
  desk_.key(Key::tab);
  EXPECT_EQ(desk_.desktop().scene().size.x, before);
}

TEST(Platforms, AnUnknownOneListsTheKnown) {
  std::string why;
  try {
    open_platform("wayland", {}, why);
    FAIL() << "taken";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("window, offscreen or null"));
  }
}

TEST(Platforms, TheNullPlatformDoesEverythingButPictures) {
  Desk desk(1280, 720, 1.0, "null");
  desk.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  desk.key(Key::right);
  desk.settle();
  EXPECT_EQ(desk.snapshot()->step, 1);
  EXPECT_FALSE(desk.desktop().window_picture());
}

}  // namespace
}  // namespace pedicel::app
