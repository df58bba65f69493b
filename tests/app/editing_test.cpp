// Editing a drawn plant in the scene, by real input events off screen.
#include "app/editors/stem_editor.h"
#include "app/tools/radius_handles.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/point_kind.h"
#include "tests/app/desk.h"

namespace pedicel::app {
namespace {

class Editing : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.open_empty();
    for (const char* line :
         {"new plant p", "draw stem p stem 0,0,0;0,0,0.15;0,0,0.3;0,0,0.45 0.006",
          "draw stem p branch 0,0,0.3;0.08,0.05,0.34;0.16,0.1,0.36 0.003",
          "add leaf p leaf stem 0.75 0.08 direction=-0.7,-0.7,0"})
      ASSERT_TRUE(desk_.session().run_text(line).ok);
    desk_.settle();
    desk_.key(Key::home);
    desk_.key(Key::d);
    steps_ = desk_.session().history().size();
  }
  const plant::PlantFile& plant() { return desk_.session().document().plant("p"); }
  const plant::PlantCurve& curve(const std::string& name) {
    return plant().curves[static_cast<std::size_t>(plant::find_stem(plant(), name))];
  }
  /// One step of the history was made since the last call.
  void expect_one_step() {
    EXPECT_EQ(desk_.session().history().size(), ++steps_) << desk_.ui().notice;
  }
  void choose(const std::string& stem, int point) {
    choose_curve(desk_.ui(), "p", stem);
    if (point < 0) return;
    desk_.ui().selection.kind = Selection::Kind::curve_point;
    desk_.ui().selection.point = point;
  }
  Desk desk_;
  std::size_t steps_ = 0;
};

// The foot of a stroke is snapped to the stem's middle, some millimetres from the pointer's ray.
TEST_F(Editing, AClickOnAStemChoosesItAndDrawsNothing) {
  const auto hash = desk_.session().document().state_hash();
  const ImVec2 at = desk_.at(Vec3(0, 0, 0.2));
  for (const float beside : {-3.0f, -1.5f, 0.0f, 1.5f, 3.0f}) {
    desk_.ui().selection = {};
    desk_.frames(2);
    desk_.move(at.x + beside, at.y);
    desk_.button(0, true);
    desk_.move(at.x + beside + 1.0f, at.y - 1.0f);  // a hand slips
    desk_.button(0, false);
    desk_.frames(25);
    EXPECT_EQ(desk_.session().document().state_hash(), hash) << beside << " px beside";
    EXPECT_EQ(desk_.ui().selection.kind, Selection::Kind::curve) << beside << " px beside";
    EXPECT_EQ(desk_.ui().selection.curve, "stem");
  }
}

// A dialog is what a person is at: keys are not for what lies behind it.
TEST_F(Editing, KeysDoNotActBehindADialog) {
  choose("branch", -1);
  desk_.key(Key::f1);
  ASSERT_EQ(desk_.ui().dialog, Dialog::help);
  const auto hash = desk_.session().document().state_hash();
  desk_.key(Key::del);
  desk_.key(Key::z, true);
  desk_.key(Key::space);
  desk_.key(Key::d);
  EXPECT_EQ(desk_.session().document().state_hash(), hash);
  EXPECT_EQ(desk_.snapshot()->mode, RunMode::paused);
  EXPECT_TRUE(desk_.ui().draw.on);
  desk_.key(Key::escape);
  EXPECT_EQ(desk_.ui().dialog, Dialog::none);
  EXPECT_TRUE(desk_.ui().draw.on) << "Esc was the dialog's";
  desk_.key(Key::del);
  EXPECT_NE(desk_.session().document().state_hash(), hash);
}

TEST_F(Editing, NothingIsDrawnBehindADialog) {
  const auto hash = desk_.session().document().state_hash();
  const ImGuiWindow* scene = ImGui::FindWindowByName("scene");
  ASSERT_NE(scene, nullptr);
  const ImVec2 at(scene->Pos.x + 30, scene->Pos.y + scene->Size.y - 60);  // beside the dialog
  const std::vector<ImVec2> stroke{at, ImVec2(at.x + 40, at.y - 20), ImVec2(at.x + 80, at.y - 30)};
  desk_.ui().dialog = Dialog::info;
  desk_.frames(3);
  desk_.drag(stroke);
  desk_.settle();
  EXPECT_EQ(desk_.session().document().state_hash(), hash);
  desk_.ui().dialog = Dialog::none;
  desk_.frames(3);
  desk_.drag(stroke);
  desk_.settle();
  EXPECT_NE(desk_.session().document().state_hash(), hash) << "the same stroke without it";
}

TEST_F(Editing, ARadiusHandleIsDraggedAcrossTheStem) {
  choose("stem", -1);
  desk_.frames(2);
  std::optional<RadiusHandle> handle;
  for (const RadiusHandle& one :
       radius_handles(curve("stem"), Pose{}, desk_.desktop().scene().frame(), 1.0))
    if (one.point == 1 && one.away.x > 0.5f) handle = one;
  ASSERT_TRUE(handle);
  const float px = static_cast<float>(0.004 / handle->metres);
  desk_.move(handle->at.x, handle->at.y);
  desk_.button(0, true);
  desk_.move(handle->at.x + 0.5f * px, handle->at.y);
  EXPECT_NEAR(curve("stem").radius[1], 0.008, 4e-4) << "while it is dragged";
  desk_.move(handle->at.x + px, handle->at.y);
  desk_.button(0, false);
  desk_.settle();
  ASSERT_EQ(curve("stem").radius.size(), 4u);
  EXPECT_NEAR(curve("stem").radius[1], 0.010, 4e-4);
  EXPECT_EQ(curve("stem").radius[0], 0.006) << "the others keep theirs";
  expect_one_step();
  double thickest = 0.0;
  const auto snapshot = desk_.snapshot();
  for (const auto& element : snapshot->plants[0].model->elements)
    thickest = std::max(thickest, element.radius_near);
  EXPECT_GT(thickest, 0.0085) << "it is simulated so";
  desk_.key(Key::z, true);
  EXPECT_EQ(curve("stem").radius, std::vector<double>{0.006});
}

TEST_F(Editing, KeysChangeTheKindOfTheChosenPoint) {
  ASSERT_TRUE(desk_.session()
                  .run_text("draw stem p bow 0,0,0.1;0.06,0,0.14;0.12,0,0.1;0.18,0,0.16;0.24,0,0.1 "
                            "0.003")
                  .ok);
  desk_.settle();
  steps_ = desk_.session().history().size();
  choose("bow", -1);
  const ImVec2 middle = desk_.at(Vec3(0.12, 0, 0.1));
  desk_.click(middle.x, middle.y);
  ASSERT_EQ(desk_.ui().selection.kind, Selection::Kind::curve_point);
  for (const plant::PointKind kind :
       {plant::PointKind::corner, plant::PointKind::linear, plant::PointKind::smooth}) {
    desk_.key(Key::v);
    EXPECT_EQ(plant::point_kind(curve("bow"), desk_.ui().selection.point), kind);
    expect_one_step();
  }
  EXPECT_EQ(curve("bow").points.size(), 5u) << "smooth again";
  desk_.click(desk_.at(Vec3(0, 0, 0.1)).x, desk_.at(Vec3(0, 0, 0.1)).y);
  desk_.key(Key::v);
  EXPECT_EQ(plant::point_kind(curve("bow"), 0), plant::PointKind::linear) << "an end has no corner";
}

TEST_F(Editing, PointsAreInsertedSmoothedAndDeletedByKeys) {
  choose("branch", 1);
  desk_.key(Key::insert);
  ASSERT_EQ(curve("branch").points.size(), 4u);
  EXPECT_EQ(desk_.ui().selection.point, 2) << "the new one is chosen";
  expect_one_step();
  const Vec3 before = curve("branch").points[2];
  desk_.session().run(Command(
      "move point",
      {{"plant", "p"}, {"stem", "branch"}, {"point", 2}, {"to", Vec3(before + Vec3(0, 0, 0.05))}}));
  expect_one_step();
  desk_.key(Key::s);
  EXPECT_LT(curve("branch").points[2].z(), before.z() + 0.04);
  expect_one_step();
  desk_.key(Key::del);
  EXPECT_EQ(curve("branch").points.size(), 3u);
  expect_one_step();
}

TEST_F(Editing, ALeafIsDraggedAlongItsStem) {
  const auto snapshot = desk_.snapshot();
  const PlantSnapshot& plant_now = snapshot->plants[0];
  const auto& blades = snapshot->assets->plants[0].blades;
  ASSERT_FALSE(blades.empty());
  Vec3 on_leaf = Vec3::Zero();
  for (const simulation::BladeCorner& corner : blades[blades.size() / 2])
    on_leaf += point_on(*plant_now.model, plant_now.state, corner.element, corner.back) / 3.0;
  const ImVec2 from = desk_.at(on_leaf);
  const ImVec2 low = desk_.at(Vec3(0, 0, 0.1)), high = desk_.at(Vec3(0, 0, 0.45 * 0.75));
  desk_.move(from.x, from.y);
  ASSERT_EQ(describe(desk_.ui().hover, *desk_.snapshot()), "p/leaf");
  desk_.button(0, true);
  desk_.move(from.x + 0.5f * (low.x - high.x), from.y + 0.5f * (low.y - high.y));
  EXPECT_LT(plant().leaves[0].place.at, 0.6) << "while it is dragged";
  desk_.move(from.x + low.x - high.x, from.y + low.y - high.y);
  desk_.button(0, false);
  desk_.settle();
  EXPECT_EQ(plant().leaves[0].place.curve, "stem");
  EXPECT_NEAR(plant().leaves[0].place.at, 0.1 / 0.45, 0.04);
  expect_one_step();
  desk_.key(Key::z, true);
  EXPECT_EQ(plant().leaves[0].place.at, 0.75);
}

TEST_F(Editing, AltClickChoosesToTheTipAndDelCutsIt) {
  for (const bool drawing : {true, false}) {
    desk_.ui().draw.on = drawing;
    desk_.ui().selection = {};
    const ImVec2 at = desk_.at(Vec3(0, 0, 0.2));
    desk_.hold(Key::left_alt, true);
    desk_.click(at.x, at.y);
    desk_.hold(Key::left_alt, false);
    EXPECT_TRUE(desk_.ui().selection.to_tip) << drawing;
    EXPECT_EQ(describe(desk_.ui().selection, *desk_.snapshot()), "p/stem");
  }
  desk_.key(Key::del);
  desk_.settle();
  EXPECT_NEAR(plant::stem_curve(plant(), "stem").length(), 0.2, 0.02);
  EXPECT_EQ(plant().curves.size(), 1u) << "the branch was beyond";
  EXPECT_TRUE(plant().leaves.empty());
  expect_one_step();
}

TEST_F(Editing, TheTrimBrushCutsWhatItCrosses) {
  desk_.ui().draw.thing = DrawThing::trim;
  const ImVec2 trunk = desk_.at(Vec3(0, 0, 0.4)), twig = desk_.at(Vec3(0.12, 0.075, 0.352));
  desk_.drag({ImVec2(trunk.x - 30, trunk.y), trunk, twig, ImVec2(twig.x + 10, twig.y + 30)});
  desk_.settle();
  EXPECT_NEAR(plant::stem_curve(plant(), "stem").length(), 0.4, 0.02);
  EXPECT_LT(plant::stem_curve(plant(), "branch").length(), 0.19);
  expect_one_step();
  const ImVec2 low = desk_.at(Vec3(0, 0, 0.1));
  desk_.click(low.x, low.y);
  desk_.settle();
  EXPECT_NEAR(plant::stem_curve(plant(), "stem").length(), 0.1, 0.02);
  expect_one_step();
}

TEST_F(Editing, AStringIsDrawnChosenAndTakenAway) {
  const auto& ties = [&]() -> const std::vector<world::SceneTie>& {
    return desk_.session().document().scene->ties;
  };
  desk_.ui().draw.thing = DrawThing::tie;
  desk_.ui().draw.tie_slack = 0.02;
  const ImVec2 foot = desk_.at(Vec3(0, 0, 0.4)), end(foot.x + 120, foot.y - 40);
  desk_.drag({foot, ImVec2(foot.x + 40, foot.y - 10), end});
  desk_.settle();
  ASSERT_EQ(ties().size(), 1u) << desk_.ui().notice;
  EXPECT_EQ(ties()[0].organ, "p/stem");
  EXPECT_NEAR(ties()[0].at, 0.4 / 0.45, 0.03);
  const double way = (ties()[0].to - Vec3(0, 0, 0.4)).norm();
  EXPECT_NEAR(ties()[0].length.value(), way + 0.02, 0.01);
  const ImVec2 there = desk_.at(ties()[0].to);
  EXPECT_NEAR(there.x, end.x, 1.0);
  EXPECT_NEAR(there.y, end.y, 1.0);
  EXPECT_EQ(describe(desk_.ui().selection, *desk_.snapshot()), "tie_1");
  expect_one_step();
  // Out of the draw mode a click on it chooses it, and Del takes it away.
  desk_.key(Key::d);
  desk_.ui().selection = {};
  desk_.click(0.3 * foot.x + 0.7 * end.x, 0.3 * foot.y + 0.7 * end.y);
  ASSERT_EQ(desk_.ui().selection.kind, Selection::Kind::tie);
  EXPECT_EQ(desk_.ui().selection.tie, 0);
  desk_.key(Key::del);
  desk_.settle();
  EXPECT_TRUE(ties().empty());
  EXPECT_EQ(desk_.ui().selection.kind, Selection::Kind::none);
  expect_one_step();
  desk_.key(Key::z, true);
  EXPECT_EQ(ties().size(), 1u);
}

TEST_F(Editing, AStringEndsAtAPostButNotAtWhatMoves) {
  for (const char* line : {"add box post 0.04,0.04,0.5 position=0.25,0,0.25",
                           "add sphere ball 0.04 mass=0.1 position=-0.25,0,0.4"})
    ASSERT_TRUE(desk_.session().run_text(line).ok);
  desk_.settle();
  desk_.key(Key::home);
  steps_ = desk_.session().history().size();
  desk_.ui().draw.thing = DrawThing::tie;
  const ImVec2 foot = desk_.at(Vec3(0, 0, 0.4));
  const ImVec2 post = desk_.at(Vec3(0.25, 0, 0.4)), ball = desk_.at(Vec3(-0.25, 0, 0.4));
  desk_.drag({foot, ImVec2(0.5f * (foot.x + post.x), foot.y), post});
  desk_.settle();
  const auto& scene = [&]() -> const world::Scene& { return *desk_.session().document().scene; };
  ASSERT_EQ(scene().ties.size(), 1u) << desk_.ui().notice;
  // On its surface.
  const Vec3 off = scene().ties[0].to - Vec3(0.25, 0, 0.25);
  EXPECT_LT(std::abs(std::max(std::abs(off.x()), std::abs(off.y())) - 0.02), 1e-4);
  expect_one_step();
  desk_.drag({foot, ImVec2(0.5f * (foot.x + ball.x), foot.y), ball});
  EXPECT_EQ(scene().ties.size(), 1u);
  EXPECT_NE(desk_.ui().notice.find("ball moves"), std::string::npos) << desk_.ui().notice;
  // To another stem it is one between the two. It begins where the last one did, soon after it:
  // that is no double click, which would move the view from under the string.
  const ImVec2 twig = desk_.at(Vec3(0.12, 0.075, 0.352));
  desk_.drag({foot, ImVec2(0.5f * (foot.x + twig.x), 0.5f * (foot.y + twig.y)), twig});
  desk_.settle();
  ASSERT_EQ(scene().ties.size(), 2u) << desk_.ui().notice;
  EXPECT_EQ(scene().ties[1].to_organ, "p/branch");
  EXPECT_GT(scene().ties[1].to_at.value_or(0.0), 0.4);
  const ImVec2 still = desk_.at(Vec3(0.12, 0.075, 0.352));
  EXPECT_EQ(still.x, twig.x);
  EXPECT_EQ(still.y, twig.y);
  expect_one_step();
  // From nothing no string begins.
  desk_.drag({ImVec2(foot.x + 60, foot.y - 60), post});
  EXPECT_EQ(scene().ties.size(), 2u);
}

TEST_F(Editing, TheWheelMakesAStrokeThicker) {
  const ImVec2 from = desk_.at(Vec3(0, 0, 0.2));
  const ViewCamera camera = desk_.desktop().scene().camera();
  desk_.ui().draw.radius_min = desk_.ui().draw.radius_max = 0.002;
  desk_.move(from.x, from.y);
  desk_.button(0, true);
  for (int i = 1; i < 6; ++i) desk_.move(from.x + 8 * i, from.y);
  desk_.wheel(5);
  desk_.key(Key::up);
  for (int i = 6; i < 12; ++i) desk_.move(from.x + 8 * i, from.y);
  desk_.button(0, false);
  desk_.settle();
  ASSERT_EQ(plant().curves.size(), 3u) << desk_.ui().notice;
  EXPECT_NEAR(plant().curves[2].radius.front(), 0.002, 1e-6);
  EXPECT_NEAR(plant().curves[2].radius.back(), 0.002 * std::pow(1.1, 6), 1e-5);
  EXPECT_TRUE(desk_.desktop().scene().camera() == camera) << "the wheel is the stroke's";
  expect_one_step();
}

TEST_F(Editing, RepeatTakesTypedNumbers) {
  desk_.key(Key::d);
  choose("branch", -1);
  DrawMode& d = desk_.ui().draw;
  d.copies = 2, d.copy_spacing = 0.05, d.copy_angle = 1.0;
  desk_.show("Plants");
  ImGuiWindow* details = nullptr;
  for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->WasActive && std::string(window->Name).find("details") != std::string::npos)
      details = window;
  ASSERT_NE(details, nullptr);
  // The button is below the fields, near the end of the part that scrolls.
  for (float off = 0; plant().curves.size() == 2 && off < details->ScrollMax.y + 40; off += 40) {
    ImGui::SetScrollY(details, off);
    desk_.frames(3);
    for (float y = details->InnerRect.Min.y + 6;
         plant().curves.size() == 2 && y < details->InnerRect.Max.y - 6; y += 12) {
      desk_.move(details->InnerRect.GetCenter().x, y);
      if (ImGui::GetCurrentContext()->HoveredId != details->GetID("Repeat")) continue;
      desk_.click(details->InnerRect.GetCenter().x, y);
    }
  }
  EXPECT_EQ(plant().curves.size(), 4u);
  expect_one_step();
}

}  // namespace
}  // namespace pedicel::app
