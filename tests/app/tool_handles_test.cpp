// The robot's tool dragged by its handles with a real mouse, the ghost of its goal, its programs.
#include <fstream>

#include "app/session/session_robot.h"
#include "tests/app/cut_text.h"
#include "tests/app/desk.h"
#include "tests/app/words.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

/// Without pictures, which take most of the time, where none is looked at.
class ToolHandlesTest : public ::testing::Test {
 protected:
  explicit ToolHandlesTest(const std::string& platform = "null")
      : desk_(1280, 1200, 1.0, platform) {}
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.draw_coarsely();
    desk_.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
    // To where the arm can go any way.
    desk_.session().control().run_for(1.0);
    desk_.settle();
    desk_.session().run_text("stop robot");
    desk_.show("Robot");
    desk_.settle();
  }
  ToolGoal goal() { return desk_.session().robot().tool_goal().value(); }
  ImVec2 grip(const std::string& part) {
    const auto at =
        desk_.desktop().scene().tool_handles().grip(part, desk_.desktop().scene().frame());
    EXPECT_TRUE(at) << "no handle " << part << " is seen";
    return at.value_or(ImVec2(0, 0));
  }
  void drag(const std::string& part, float dx, float dy) {
    const ImVec2 at = grip(part);
    desk_.drag({at, ImVec2(at.x + 0.5f * dx, at.y + 0.5f * dy), ImVec2(at.x + dx, at.y + dy)});
    desk_.settle();
  }
  /// Along an arrow as it is seen, px.
  void pull(const std::string& arrow, float px) {
    const ImVec2 from = grip("knob"), to = grip(arrow);
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    drag(arrow, px * (to.x - from.x) / length, px * (to.y - from.y) / length);
  }
  void click(const std::string& words) {
    const auto at = place_of("right", words);
    ASSERT_TRUE(at) << words << " is not to be read in the panel\n" << keep("no_" + words);
    desk_.click(at->x, at->y);
    desk_.settle();
  }
  std::string keep(const std::string& name) {
    const auto picture = desk_.desktop().window().picture();
    if (!picture) return "";
    const std::string path = ::testing::TempDir() + "/tool_" + name + ".png";
    render::write_png(path, *picture);
    return "picture: " + path;
  }
  void expect_whole_words(const std::string& name) {
    const auto cut = cut_letters();
    EXPECT_TRUE(cut.empty()) << describe(cut) << keep(name);
    for (const auto& [window, px] : overflowing())
      ADD_FAILURE() << window << " is too narrow by " << px << " px\n" << keep(name);
  }

  TemporaryFolder folder_;
  Desk desk_;
};

class ToolPicturesTest : public ToolHandlesTest {
 protected:
  ToolPicturesTest() : ToolHandlesTest("offscreen") {}
};

TEST_F(ToolHandlesTest, AnArrowMovesTheToolAlongItsAxisAloneAndTheArmFollows) {
  const ViewCamera camera = desk_.desktop().scene().camera();
  const Pose before = goal().asked_W;
  pull("z", 40);
  const Pose after = goal().asked_W;
  const Vec3 moved = after.position - before.position;
  EXPECT_GT(moved.z(), 0.01);
  EXPECT_LT(moved.z(), 0.3);
  EXPECT_NEAR(moved.head<2>().norm(), 0.0, 1e-9);
  EXPECT_NEAR(after.rotation.angularDistance(before.rotation), 0.0, 1e-9);
  EXPECT_TRUE(desk_.desktop().scene().camera() == camera) << "the view stays";
  // The pointer is still on the arrow: the tool has gone as far as the hand.
  const ImVec2 tip = grip("z");
  EXPECT_NEAR(std::hypot(tip.x - ImGui::GetIO().MousePos.x, tip.y - ImGui::GetIO().MousePos.y), 0.0,
              3.0);
  ASSERT_TRUE(robot_ghost(*desk_.snapshot()));
  desk_.session().control().run_for(1.5);
  desk_.settle();
  EXPECT_NEAR((desk_.snapshot()->robot.tool.position - after.position).norm(), 0.0, 3e-3);
  EXPECT_FALSE(robot_ghost(*desk_.snapshot()));
}

TEST_F(ToolHandlesTest, ARingTurnsTheToolAboutItsAxis) {
  const Pose before = goal().asked_W;
  drag("ry", 18, 14);
  const Eigen::AngleAxisd turn(goal().asked_W.rotation * before.rotation.conjugate());
  EXPECT_GT(std::abs(turn.angle()), 0.05);
  EXPECT_NEAR(std::abs(turn.axis().y()), 1.0, 1e-6);
  EXPECT_NEAR((goal().asked_W.position - before.position).norm(), 0.0, 1e-9);
  // With the tool's own axes the ring's axis is the tool's.
  desk_.ui().view.tool_axes = true;
  desk_.frames(2);
  const Pose start = goal().asked_W;
  drag("rz", 40, 30);
  const Eigen::AngleAxisd own(start.rotation.conjugate() * goal().asked_W.rotation);
  EXPECT_GT(std::abs(own.angle()), 0.03);
  EXPECT_NEAR(std::abs(own.axis().z()), 1.0, 1e-6);
}

TEST_F(ToolHandlesTest, TheKnobMovesAcrossTheView) {
  const Vec3 before = goal().asked_W.position;
  drag("knob", 25, -15);
  const Vec3 moved = goal().asked_W.position - before;
  const render::Camera camera = desk_.desktop().scene().frame().camera;
  EXPECT_GT(moved.norm(), 0.01);
  EXPECT_NEAR(moved.dot((camera.target - camera.eye).normalized()), 0.0, 1e-6);
}

TEST_F(ToolHandlesTest, OutOfReachTheArmGoesAsNearAsItCan) {
  const Vec3 before = goal().asked_W.position;
  pull("x", -300);
  EXPECT_FALSE(goal().reached);
  EXPECT_LT(goal().asked_W.position.x(), before.x() - 0.2) << "the handles go with the hand";
  desk_.session().control().run_for(5.0);
  desk_.settle();
  EXPECT_NEAR((desk_.snapshot()->robot.tool.position - goal().nearest_W.position).norm(), 0.0,
              0.01);
}

TEST_F(ToolPicturesTest, OutOfReachIsSaidInWordsAndColour) {
  const auto red_share = [&] {
    const render::Image image = desk_.picture();
    const SceneFrame& scene = desk_.desktop().scene().frame();
    long found = 0;
    for (int y = static_cast<int>(scene.low.y); y < scene.low.y + scene.size.y; ++y)
      for (int x = static_cast<int>(scene.low.x); x < scene.low.x + scene.size.x; ++x) {
        const std::uint8_t* p = image.at(x, y);
        found += p[0] > 150 && p[1] < 75 && p[2] < 65;
      }
    return found;
  };
  const long before = red_share();
  pull("x", -300);
  EXPECT_FALSE(goal().reached);
  EXPECT_TRUE(desk_.ui().view.goal_missed);
  desk_.frames(2);
  EXPECT_TRUE(place_of("scene", "unreachable")) << "beside the handles\n" << keep("unreachable");
  EXPECT_TRUE(place_of("right", "unreachable")) << "in the panel\n" << keep("unreachable");
  EXPECT_GT(red_share(), before + 1000) << keep("unreachable");
  expect_whole_words("unreachable");
  pull("x", 300);
  EXPECT_TRUE(goal().reached);
  EXPECT_FALSE(place_of("scene", "unreachable"));
}

TEST_F(ToolHandlesTest, EscGivesTheDragUpAndGPutsTheHandlesAway) {
  const Vec3 before = goal().asked_W.position;
  const ImVec2 at = grip("x");
  desk_.move(at.x, at.y);
  desk_.button(0, true);
  desk_.move(at.x + 30, at.y);
  desk_.move(at.x + 50, at.y);
  EXPECT_GT((goal().asked_W.position - before).norm(), 0.005);
  desk_.key(Key::escape);
  desk_.button(0, false);
  desk_.settle();
  EXPECT_NEAR((goal().asked_W.position - before).norm(), 0.0, 1e-9);
  desk_.key(Key::g);
  EXPECT_FALSE(desk_.desktop().scene().tool_handles().grip("x", desk_.desktop().scene().frame()));
  const ViewCamera camera = desk_.desktop().scene().camera();
  desk_.drag({at, ImVec2(at.x + 30, at.y)});
  EXPECT_FALSE(desk_.desktop().scene().camera() == camera) << "the left button is the view's again";
  desk_.key(Key::g);
  desk_.show("View");
  EXPECT_FALSE(desk_.desktop().scene().tool_handles().grip("x", desk_.desktop().scene().frame()))
      << "only while the robot is looked at";
}

TEST_F(ToolPicturesTest, TheGhostIsSeenUntilTheArmIsThere) {
  desk_.session().run_text("jog 0.05,-0.1,0.05");
  desk_.settle();
  desk_.ui().view.tool_handles = false;
  desk_.frames(2);
  const render::Image with = desk_.picture();
  desk_.ui().view.ghost = false;
  desk_.frames(2);
  const render::Image without = desk_.picture();
  long bluer = 0, changed = 0;
  for (std::size_t i = 0; i < with.rgb.size(); i += 3) {
    changed += with.rgb[i] != without.rgb[i];
    bluer += with.rgb[i + 2] - with.rgb[i] > without.rgb[i + 2] - without.rgb[i] + 20;
  }
  EXPECT_GT(bluer, 3000) << keep("ghost");
  EXPECT_GT(changed, bluer / 2);
}

TEST_F(ToolHandlesTest, WaypointsAreRecordedSavedLoadedPlayedAndLooped) {
  click("Record");
  desk_.session().run_text("jog 0,0,0.03");
  desk_.settle();
  click("Record");
  ASSERT_EQ(desk_.session().document().waypoints.size(), 2u);
  const auto recorded = desk_.session().document().waypoints;
  // The file's name is typed over.
  const std::string file = (folder_ / "way.csv").string();
  click("waypoints.csv");
  desk_.key(Key::a, true);
  desk_.type(file);
  desk_.key(Key::enter);
  click("Save");
  ASSERT_TRUE(std::filesystem::exists(file)) << keep("save");
  click("Clear");
  EXPECT_TRUE(desk_.session().document().waypoints.empty());
  click("Load");
  EXPECT_EQ(desk_.session().document().waypoints, recorded);
  desk_.key(Key::z, true);
  EXPECT_TRUE(desk_.session().document().waypoints.empty()) << "loading is undone";
  desk_.key(Key::z, true, true);
  click("Loop");
  click("Play");
  EXPECT_TRUE(desk_.snapshot()->robot.loops);
  desk_.session().control().run_for(1.5);
  desk_.settle();
  EXPECT_TRUE(place_of("right", "over and over")) << keep("loop");
  expect_whole_words("loop");
  click("Stop");
  EXPECT_FALSE(desk_.snapshot()->robot.follows_program);
}

}  // namespace
}  // namespace pedicel::app
