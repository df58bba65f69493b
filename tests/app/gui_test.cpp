// The window's habits, by real input events off screen.
#include <chrono>
#include <thread>

#include "app/editors/stem_editor.h"
#include "app/session/session_files.h"
#include "app/session/session_tuning.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "tests/app/desk.h"
#include "tests/app/words.h"
#include "tests/support/places.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Gui : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.draw_coarsely();
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

TEST_F(Gui, AMendedFileIsReadAgainAndItsDialogGoes) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "mended.plant.yaml";
  io::write_file_atomically(file, "curves: 3\n");
  desk_.drop(file.string());
  desk_.frames(3);
  ASSERT_EQ(desk_.ui().dialog, Dialog::problem);
  desk_.key(Key::r, true);
  desk_.frames(3);
  EXPECT_EQ(desk_.ui().dialog, Dialog::problem) << "as it was";
  io::write_file_atomically(file,
                            io::read_file(scene_file("../../plants/cherry_tomato.plant.yaml")));
  desk_.key(Key::r, true);
  desk_.settle();
  EXPECT_EQ(desk_.ui().dialog, Dialog::none);
  EXPECT_TRUE(desk_.session().messages().all().empty());
  EXPECT_EQ(desk_.session().files().path(), file);
}

// The time of a picture is what it takes, without the scene's: not less than nothing.
TEST_F(Gui, TimesOfAPictureAreNotNegative) {
  desk_.ui().times.scene = 10.0;  // as after a picture that took long
  for (int i = 0; i < 5; ++i) {
    desk_.frames(1);
    EXPECT_GE(desk_.ui().times.interface, 0.0);
  }
}

TEST_F(Gui, ASearchLeavesTheGroupsAsTheyWere) {
  desk_.show("Tune");
  const auto shown = [&] { return place_of("right", "newton_iterations").has_value(); };
  EXPECT_FALSE(shown()) << "only the plant's group is open";
  const auto field = place_of("right", "search: density");
  ASSERT_TRUE(field);
  desk_.click(field->x, field->y);
  desk_.type("newton");
  EXPECT_TRUE(shown());
  desk_.key(Key::a, true);
  desk_.key(Key::del);
  desk_.frames(3);
  EXPECT_FALSE(shown()) << "as before the search";
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
  const ViewCamera start = desk_.desktop().scene().camera();
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y + 20)});
  EXPECT_EQ(desk_.desktop().scene().camera().target(), start.target());
  EXPECT_FALSE(desk_.desktop().scene().camera() == start) << "a left drag turns";
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y)}, 1);
  EXPECT_GT((desk_.desktop().scene().camera().target() - start.target()).norm(), 0.01)
      << "a right drag moves";
  const double before = desk_.desktop().scene().camera().distance();
  desk_.move(free_x, free_y);
  desk_.wheel(2);
  EXPECT_LT(desk_.desktop().scene().camera().distance(), before);
}

TEST_F(Gui, BlenderPresetTurnsWithTheMiddleButton) {
  desk_.ui().preferences.mouse = MousePreset::blender;
  const ViewCamera start = desk_.desktop().scene().camera();
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y + 20)});
  EXPECT_TRUE(desk_.desktop().scene().camera() == start);
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y + 20)}, 2);
  EXPECT_FALSE(desk_.desktop().scene().camera() == start);
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

TEST_F(Gui, CtrlRightDragPushesAlongTheView) {
  const ImVec2 at = desk_.at(fruit_place(4));
  desk_.move(at.x, at.y);
  desk_.hold(Key::left_control, true);
  desk_.button(1, true);
  desk_.settle();
  const Vec3 start = desk_.snapshot()->pull.target_W;
  desk_.move(at.x, at.y - 40);
  desk_.settle();
  ASSERT_TRUE(desk_.snapshot()->pull.active);
  const Vec3 pushed = desk_.snapshot()->pull.target_W - start;
  EXPECT_GT(pushed.norm(), 0.02);
  EXPECT_GT(
      pushed.normalized().dot((start - desk_.desktop().scene().frame().camera.eye).normalized()),
      0.999);
  desk_.button(1, false);
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
  const auto before = desk_.session().tuning().parameters();
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
    for (const SessionParameter& p : desk_.session().tuning().parameters())
      if (p.changed) changed = p.key;
  }
  desk_.frames(5);
  ASSERT_FALSE(changed.empty()) << "no slider was found";
  EXPECT_EQ(desk_.session().history().size(), 1u)
      << "one drag is one step of the history " << changed << " " << desk_.ui().notice;
  desk_.key(Key::z, true);
  const auto after = desk_.session().tuning().parameters();
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

TEST_F(Gui, UndoWhileATextIsTypedIsTheTexts) {
  ASSERT_TRUE(desk_.session().run_text("set rods.newton_iterations 7").ok);
  desk_.settle();
  const auto hash = desk_.session().document().state_hash();
  desk_.show("Messages");
  const ImGuiWindow* panel = panel_window("bottom", "Messages");
  ASSERT_NE(panel, nullptr);
  desk_.click(panel->InnerRect.Min.x + 60, panel->InnerRect.Max.y - 14);
  desk_.type("abc");
  desk_.key(Key::z, true);
  EXPECT_EQ(desk_.session().document().state_hash(), hash);
  desk_.key(Key::escape);
  desk_.key(Key::z, true);
  EXPECT_NE(desk_.session().document().state_hash(), hash) << "the document's once it is left";
}

TEST_F(Gui, AFileThatCannotBeReadIsShownAndRetried) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "broken.plant.yaml";
  std::ofstream(path) << "format: pedicel-plant\nversion: 1\nnonsense: 3\n";
  desk_.drop(path.string());
  desk_.frames(3);
  EXPECT_EQ(desk_.ui().dialog, Dialog::problem);
  EXPECT_THAT(desk_.ui().problem, HasSubstr("broken.plant.yaml:3"));
  EXPECT_FALSE(desk_.snapshot()->plants.empty()) << "what was open stays";
  std::filesystem::copy_file(pedicel::test::source_folder() / "plants" / "young_plant.plant.yaml",
                             path, std::filesystem::copy_options::overwrite_existing);
  desk_.key(Key::escape);
  desk_.key(Key::r, true);
  desk_.settle();
  EXPECT_EQ(desk_.session().files().path(), path);
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
  const std::string name = desk_.ui().output_stem().filename().string() + "_001";
  const bool film = std::filesystem::exists(folder / (name + ".mp4")) ||
                    std::filesystem::exists(folder / (name + "_frames/frame_00000.png"));
  EXPECT_TRUE(film) << desk_.ui().notice;
}

/// A film of the playing window in a folder of its own: how many pictures it has. They are as far
/// apart in simulated time as the film says.
int film_of_playing(Desk& desk, const std::filesystem::path& folder) {
  const auto before = std::filesystem::current_path();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  desk.session().control().reset();
  desk.settle();
  EXPECT_TRUE(desk.session().run_text("record f_%02d.png fps=20 ui=1").ok);
  desk.session().control().play();
  desk.session().control().wait();
  desk.frames(40);
  desk.session().control().pause();
  const Result ended = desk.session().run_text("stop recording");
  EXPECT_TRUE(ended.ok) << ended.text;
  desk.settle();
  std::filesystem::current_path(before);
  const auto pictures = std::distance(std::filesystem::directory_iterator(folder), {});
  EXPECT_NEAR(desk.snapshot()->time, static_cast<double>(pictures) / 20, 0.0043);
  return static_cast<int>(pictures);
}

// Whatever the machine does, and nothing in them goes by the wall clock.
TEST_F(Gui, TwoFilmsOfTheSameRunAreTheSame) {
  const auto folder = std::filesystem::path(::testing::TempDir());
  desk_.show("Profiler");
  const int pictures = film_of_playing(desk_, folder / "film_a");
  EXPECT_GE(pictures, 12) << "20 a second of 40 / 60 s";
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  EXPECT_NEAR(film_of_playing(desk_, folder / "film_b"), pictures, 1);
  for (int i = 0; i < pictures - 1; ++i) {
    const std::string name = "f_" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".png";
    EXPECT_EQ(io::read_file(folder / "film_a" / name), io::read_file(folder / "film_b" / name))
        << name;
  }
  EXPECT_FALSE(desk_.ui().filmed);
}

TEST_F(Gui, ACameraThatFollowsGoesWithTheFruit) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "follow.scene.yaml";
  std::string text = io::read_file(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  const std::string root = pedicel::test::source_folder();
  text.replace(text.find("../../plants"), 12, root + "/plants");
  text.replace(text.find("../robots"), 9, root + "/assets/robots");
  const std::size_t cameras = text.find("cameras:\n") + 9;
  text.insert(cameras, "  - {name: with, eye: [0.3, -0.3, 0.1], follow: {fruit: truss/fruit_5}}\n");
  std::ofstream(path) << text;
  desk_.open(path);
  const Vec3 start = desk_.desktop().scene().camera().target();
  EXPECT_NEAR((start - fruit_place(4)).norm(), 0.0, 1e-9);
  desk_.session().control().run_for(2.6);
  desk_.settle();
  const Vec3 pulled = desk_.desktop().scene().camera().target();
  EXPECT_NEAR((pulled - fruit_place(4)).norm(), 0.0, 1e-9);
  EXPECT_GT((pulled - start).norm(), 1e-3);
  desk_.drag({ImVec2(free_x, free_y), ImVec2(free_x + 60, free_y)}, 1);
  const Vec3 by_hand = desk_.desktop().scene().camera().target();
  desk_.session().control().run_for(0.3);
  desk_.settle();
  EXPECT_EQ(desk_.desktop().scene().camera().target(), by_hand) << "it is led by hand now";
}

TEST_F(Gui, EditsThatAreNotSavedAreAskedAbout) {
  ASSERT_TRUE(desk_.session().run_text("new plant x").ok);
  desk_.key(Key::q, true);
  EXPECT_EQ(desk_.ui().dialog, Dialog::unsaved);
  EXPECT_TRUE(desk_.desktop().frame());
  desk_.key(Key::escape);
  EXPECT_EQ(desk_.ui().dialog, Dialog::none);
  desk_.drop(scene_file("greenhouse_bend.scene.yaml").string());
  EXPECT_EQ(desk_.ui().dialog, Dialog::unsaved);
  desk_.frames(3);
  const auto cancel = place_of("Edits", "Cancel");
  ASSERT_TRUE(cancel);
  desk_.click(cancel->x, cancel->y);
  EXPECT_EQ(desk_.session().files().path().filename(), "cherry_tomato_pull_aside.scene.yaml");
  EXPECT_GE(desk_.session().document().plant_index("x"), 0);
  desk_.key(Key::q, true);
  desk_.frames(3);
  const auto leave = place_of("Edits", "Do not save");
  ASSERT_TRUE(leave);
  desk_.click(leave->x, leave->y);
  EXPECT_FALSE(desk_.desktop().frame()) << "it has ended";
}

TEST_F(Gui, APlantIsImportedBesideTheOthers) {
  desk_.show("Plants");
  const auto button = place_of("left", "Import");
  ASSERT_TRUE(button);
  desk_.click(button->x, button->y);
  ASSERT_EQ(desk_.ui().dialog, Dialog::import_plant);
  desk_.type((pedicel::test::source_folder() / "plants" / "young_plant.plant.yaml").string());
  desk_.key(Key::enter);
  desk_.settle();
  EXPECT_EQ(desk_.ui().dialog, Dialog::none);
  EXPECT_EQ(desk_.session().document().plants.size(), 2u);
  EXPECT_EQ(desk_.snapshot()->plants.size(), 2u);
}

TEST_F(Gui, FFramesWhatIsChosen) {
  const auto framed = [&](const Vec3& middle, double nearer_than) {
    desk_.key(Key::home);
    desk_.key(Key::f);
    desk_.frames(2);
    EXPECT_LT((desk_.desktop().scene().camera().target() - middle).norm(), 0.02);
    EXPECT_LT(desk_.desktop().scene().camera().distance(), nearer_than);
  };
  choose_fruit(desk_.ui(), "truss", "fruit_2");
  framed(fruit_place(1), 0.25);
  choose_curve(desk_.ui(), "truss", "petiole_1");
  const auto& file = *desk_.session().document().plants[0].file;
  const plant::PlantCurve& petiole =
      file.curves[static_cast<std::size_t>(file.curve_index("petiole_1"))];
  Eigen::AlignedBox3d box;
  for (const Vec3& point : petiole.points)
    box.extend(desk_.snapshot()->assets->scene.plants[0].pose * point);
  framed(box.center(), 0.8);
  desk_.ui().selection.kind = Selection::Kind::curve_point;
  desk_.ui().selection.point = 1;
  framed(desk_.snapshot()->assets->scene.plants[0].pose * petiole.points[1], 0.4);
}

TEST_F(Gui, TheProfilerHasItsFiguresAndPlotsNameTheirLines) {
  desk_.session().control().run_for(0.5);
  desk_.settle();
  desk_.show("Profiler");
  const auto written = [] {
    std::string text;
    for (const SeenLetter& one : seen_letters("bottom")) text += one.letter;
    return text;
  };
  for (const char* row : {"stepsasecond[0-9]", "picturesasecond[0-9]", "drawlist[0-9]"})
    EXPECT_THAT(written(), ::testing::ContainsRegex(row));
  desk_.show("Plots");
  const auto names = desk_.session().control().log().names();
  const auto shown = std::ranges::find_if(
      names, [](const std::string& one) { return one.find("margin") != std::string::npos; });
  ASSERT_NE(shown, names.end());
  std::string in_the_plot;
  for (const SeenLetter& one : seen_letters("bottom"))
    if (one.low.x > 530) in_the_plot += one.letter;
  EXPECT_THAT(in_the_plot, HasSubstr(*shown));
}

TEST_F(Gui, TabHidesThePanelsAndTheSceneGrows) {
  const float before = desk_.desktop().scene().frame().size.x;
  desk_.key(Key::tab);
  EXPECT_GT(desk_.desktop().scene().frame().size.x, before + 300);
  desk_.key(Key::tab);
  EXPECT_EQ(desk_.desktop().scene().frame().size.x, before);
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
  EXPECT_FALSE(desk.desktop().window().picture());
}

}  // namespace
}  // namespace pedicel::app
