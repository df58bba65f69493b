// Scenes are built, changed, saved and left in the window as a person does it.
#include "app/editors/thing_editor.h"
#include "app/session/session_files.h"
#include "tests/app/empty_desk.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class BuildingInWindow : public EmptyDesk {
 protected:
  void draw() {
    run("new plant herb");
    run("draw stem herb stem 0,0,0;0,0,0.3 0.004");
    desk_.settle();
  }
  void type_name(const std::filesystem::path& file) {
    desk_.frames(4);
    desk_.key(Key::a, true);
    desk_.type(file.string());
    desk_.key(Key::enter);
    desk_.settle();
  }
};

TEST_F(BuildingInWindow, ANewSceneIsSavedAsOne) {
  draw();
  run("add sphere ball 0.03 position=0.3,0,0.03");
  desk_.settle();
  desk_.key(Key::s, true);
  ASSERT_EQ(ui().dialog, Dialog::save_as);
  desk_.frames(4);
  EXPECT_TRUE(place_of("Save as", "herb.scene.yaml")) << "a name that fits";
  type_name(folder_ / "made");
  EXPECT_EQ(ui().dialog, Dialog::none);
  EXPECT_TRUE(there(folder_ / "made.scene.yaml")) << "the ending is added";
  EXPECT_TRUE(there(folder_ / "herb.plant.yaml"));
  EXPECT_FALSE(desk_.session().files().dirty());
}

TEST_F(BuildingInWindow, AFileThatIsThereIsAskedAbout) {
  draw();
  std::ofstream(folder_ / "made.scene.yaml") << "precious";
  desk_.key(Key::s, true);
  type_name(folder_ / "made.scene.yaml");
  ASSERT_EQ(ui().dialog, Dialog::overwrite);
  desk_.frames(3);
  press("Write over a file", "Cancel");
  EXPECT_EQ(ui().dialog, Dialog::none);
  EXPECT_TRUE(desk_.session().files().dirty());
  desk_.key(Key::s, true);
  type_name(folder_ / "made.scene.yaml");
  desk_.frames(3);
  press("Write over a file", "Write over it");
  EXPECT_EQ(ui().dialog, Dialog::none);
  EXPECT_FALSE(desk_.session().files().dirty());
  EXPECT_TRUE(there(folder_ / "made.scene.yaml~"));
}

TEST_F(BuildingInWindow, APlantNameSavesTheChosenPlant) {
  draw();
  run("new plant other");
  run("draw stem other s 0.5,0,0;0.5,0,0.3 0.004");
  desk_.settle();
  choose_plant(ui(), "other");
  desk_.key(Key::s, true, true);
  type_name(folder_ / "one.plant.yaml");
  Diagnostics diagnostics;
  const auto read = plant::read_plant_file(folder_ / "one.plant.yaml", diagnostics);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->curves[0].name, "s");
  EXPECT_TRUE(desk_.session().files().dirty()) << "the scene is not saved by that";
}

// "Do not save", and then what was to be opened cannot be: nothing is given up.
TEST_F(BuildingInWindow, EditsThatWereNotLeftStayUnsaved) {
  draw();
  std::ofstream(folder_ / "bad.scene.yaml") << "format: [";
  desk_.drop((folder_ / "bad.scene.yaml").string());
  ASSERT_EQ(ui().dialog, Dialog::unsaved);
  desk_.frames(3);
  press("Edits", "Do not save");
  EXPECT_EQ(desk_.session().document().plants.size(), 1u);
  EXPECT_TRUE(desk_.session().files().dirty());
  ui().dialog = Dialog::none;
  desk_.frames(2);
  desk_.key(Key::q, true);
  EXPECT_EQ(ui().dialog, Dialog::unsaved) << "asked again";
}

TEST_F(BuildingInWindow, SavedUnderANameItGoesOnWithWhatWasAsked) {
  draw();
  desk_.key(Key::n, true);
  ASSERT_EQ(ui().dialog, Dialog::unsaved);
  desk_.frames(3);
  press("Edits", "Save");
  ASSERT_EQ(ui().dialog, Dialog::save_as);
  type_name(folder_ / "made.scene.yaml");
  EXPECT_TRUE(there(folder_ / "made.scene.yaml"));
  EXPECT_TRUE(desk_.session().document().plants.empty()) << "and then the new scene";
}

TEST_F(BuildingInWindow, ThingsComeFromTheMenuAndHaveTheirNumbers) {
  press("toolbar", "Add");
  press("##Popup", "Box");
  ASSERT_EQ(scene().bodies.size(), 1u);
  EXPECT_EQ(describe(ui().selection, *desk_.snapshot()), "box");
  desk_.show("Plants");
  EXPECT_TRUE(place_of("left", "Turn about x"));
  desk_.key(Key::d, true);
  desk_.settle();
  ASSERT_EQ(scene().bodies.size(), 2u);
  EXPECT_EQ(scene().bodies[1].name, "box_2");
  desk_.key(Key::del);
  desk_.settle();
  EXPECT_EQ(scene().bodies.size(), 1u);
  EXPECT_FALSE(ui().selection);
  press("toolbar", "Add");
  press("##Popup", "Camera as");
  EXPECT_EQ(scene().cameras.size(), 1u);
  press("toolbar", "Add");
  press("##Popup", "Robot stalk6");
  ASSERT_TRUE(scene().robot) << ui().notice;
  EXPECT_TRUE(desk_.snapshot()->robot.present);
}

TEST_F(BuildingInWindow, NumbersThatAreTypedMoveAndTurn) {
  run("add box box 0.1,0.1,0.1 position=0,0,0.05");
  desk_.settle();
  choose_body(ui(), "box");
  desk_.show("Plants");
  const auto label = place_of("left", "Place x, y, z");
  ASSERT_TRUE(label);
  desk_.click(40, label->y + ImGui::GetFrameHeightWithSpacing());
  desk_.key(Key::a, true);
  desk_.type("123.5");
  desk_.key(Key::enter);
  desk_.settle();
  EXPECT_NEAR(scene().bodies[0].pose.position.x(), 0.1235, 1e-12);
  EXPECT_EQ(scene().bodies[0].pose.position.z(), 0.05);
}

TEST_F(BuildingInWindow, AStemOfTheRobotsProgramGoesWithTheProgram) {
  desk_.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  choose_plant(ui(), "truss");
  desk_.key(Key::del);
  desk_.settle();
  EXPECT_TRUE(desk_.session().document().plants.empty()) << ui().notice;
  EXPECT_TRUE(scene().robot->waypoints.empty());
  EXPECT_THAT(ui().notice, HasSubstr("the robot's program"));
  desk_.key(Key::z, true);
  desk_.settle();
  EXPECT_EQ(desk_.session().document().plants.size(), 1u);
  EXPECT_FALSE(scene().robot->waypoints.empty()) << "in one step";
  EXPECT_FALSE(desk_.session().files().dirty());
}

}  // namespace
}  // namespace pedicel::app
