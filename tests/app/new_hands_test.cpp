// What a person does who has read only the README: types and leaves fields, mistypes paths, adds
// one thing after the other, asks for pictures and exports.
#include "app/editors/add_menu.h"
#include "app/editors/thing_editor.h"
#include "app/session/session_files.h"
#include "engine/io/atomic_file.h"
#include "tests/app/empty_desk.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class NewHands : public EmptyDesk {
 protected:
  /// A letter as keyboards send it: press, text, release.
  void send_letter(Key key, const std::string& text) {
    desk_.send(InputEvent::press(key, true));
    desk_.send(InputEvent::typed(text));
    desk_.send(InputEvent::press(key, false));
  }
  /// Clicks into the first of the three numbers under a name.
  void click_below(const std::string& words) {
    const auto label = place_of("left", words);
    ASSERT_TRUE(label) << words;
    desk_.click(30, label->y + 26);
  }
  void box() {
    run("add box crate 0.1,0.1,0.1 position=0.3,0,0.05");
    choose_body(ui(), "crate");
    desk_.show("Plants");
  }
  std::size_t edits() { return desk_.session().history().size(); }
};

TEST_F(NewHands, ANumberThatIsLeftByTabCounts) {
  box();
  click_below("Place x, y, z, mm");
  desk_.key(Key::a, true);
  desk_.type("700");
  desk_.key(Key::tab);
  desk_.settle();
  EXPECT_EQ(scene().bodies[0].pose.position, Vec3(0.7, 0, 0.05)) << "to the last bit";
}

TEST_F(NewHands, ANumberThatIsTypedAsItWasIsNoEdit) {
  run("add box crate 0.1,0.1,0.1 position=0.123456789,0,0.05");
  choose_body(ui(), "crate");
  desk_.show("Plants");
  const std::size_t before = edits();
  click_below("Place x, y, z, mm");
  desk_.key(Key::a, true);
  desk_.type("123.457");  // as it is shown
  desk_.key(Key::enter);
  desk_.settle();
  EXPECT_EQ(edits(), before);
}

TEST_F(NewHands, ANameThatIsLeftByTabCounts) {
  box();
  const auto label = place_of("left", "Name");
  ASSERT_TRUE(label);
  desk_.click(label->x + 150, label->y);
  desk_.key(Key::a, true);
  desk_.type("chest");
  desk_.key(Key::tab);
  desk_.settle();
  EXPECT_EQ(scene().bodies[0].name, "chest");
}

TEST_F(NewHands, QuickTypingIsTakenInOnePicture) {
  desk_.key(Key::o, true);
  desk_.frames(4);
  for (int i = 0; i < 3; ++i) send_letter(Key::a, "a"), send_letter(Key::d, "d");
  desk_.frames(3);
  EXPECT_FALSE(desk_.desktop().input_waits());
  EXPECT_TRUE(place_of("Open", "adadad"));
  EXPECT_FALSE(ui().draw.on) << "letters of a text are no keys";
}

TEST_F(NewHands, AKeyAfterTheTextHasEndedIsAKey) {
  box();
  click_below("Place x, y, z, mm");
  for (const Key key : {Key::enter, Key::d}) {
    desk_.send(InputEvent::press(key, true));
    desk_.send(InputEvent::press(key, false));
  }
  desk_.drain();
  EXPECT_TRUE(ui().draw.on);
}

TEST_F(NewHands, AMistypedPathKeepsTheDialog) {
  desk_.key(Key::o, true);
  desk_.frames(4);
  desk_.type((folder_ / "nothing.scene.yaml").string());
  desk_.key(Key::enter);
  EXPECT_EQ(ui().dialog, Dialog::open);
  EXPECT_TRUE(place_of("Open", "no such file"));
}

TEST_F(NewHands, AWarningLeavesTheSceneWhereItIs) {
  const float before = desk_.desktop().scene().frame().size.y;
  ASSERT_FALSE(ui().preferences.show_bottom);
  run("new plant p");
  run("draw stem p stem 0,0,0;0,0,0.8;0,0,1.6 0.002");
  ASSERT_FALSE(desk_.session().messages().all().empty());
  EXPECT_EQ(desk_.session().messages().all().back().severity, Severity::warning);
  EXPECT_EQ(desk_.desktop().scene().frame().size.y, before);
  EXPECT_THAT(ui().notice, HasSubstr("unstable"));
  EXPECT_TRUE(ui().unread) << "a mark says that there is more";
  desk_.show("Messages");
  EXPECT_FALSE(ui().unread);
}

TEST_F(NewHands, AWarningThatComesAgainIsOneMessage) {
  run("new plant p");
  run("draw stem p stem 0,0,0;0,0,0.8;0,0,1.6 0.002");
  const std::size_t before = desk_.session().messages().all().size();
  run("add sphere ball 0.03 position=0.5,0,0.03");
  run("add sphere other 0.03 position=0.8,0,0.03");
  EXPECT_EQ(desk_.session().messages().all().size(), before);
  EXPECT_GE(desk_.session().messages().all().back().times, 3);
}

TEST_F(NewHands, ARefusalCanBeReadLater) {
  EXPECT_FALSE(ui().run(Command("delete plant", {{"plant", std::string("none")}})));
  ASSERT_FALSE(desk_.session().messages().all().empty());
  EXPECT_THAT(desk_.session().messages().all().back().text, HasSubstr("none"));
}

TEST_F(NewHands, AnAddedRobotIsSeenAndItsPanelIsThere) {
  desk_.desktop().scene().camera().look_at(Vec3(4, 4, 0));
  desk_.frames(1);
  add_robot(ui(), scene_file("../robots/stalk6/stalk6.urdf"));
  desk_.settle();
  desk_.frames(6);
  EXPECT_TRUE(place_of("right", "Joints"));
  const SceneFrame& frame = desk_.desktop().scene().frame();
  for (const Pose& link : desk_.snapshot()->robot.links) {
    const ImVec2 at = desk_.at(link.position);
    EXPECT_GT(at.x, frame.low.x);
    EXPECT_LT(at.x, frame.low.x + frame.size.x);
  }
}

TEST_F(NewHands, BodiesThatAreAddedStandBesideEachOther) {
  for (int i = 0; i < 3; ++i) {
    press("toolbar", "Add");
    press("Popup", "Sphere");
  }
  ASSERT_EQ(scene().bodies.size(), 3u);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT((scene().bodies[a].pose.position - scene().bodies[b].pose.position).norm(), 0.1);
}

TEST_F(NewHands, APlantStaysOpenInTheTreeWhenItIsChosen) {
  run("new plant herb");
  run("draw stem herb trunk 0,0,0;0,0,0.3 0.004");
  desk_.show("Plants");
  press("left", "herb");
  EXPECT_EQ(ui().selection.kind, Selection::Kind::plant);
  EXPECT_TRUE(place_of("left", "trunk"));
}

TEST_F(NewHands, PicturesGoBesideTheScene) {
  run("add sphere ball 0.03 position=0.3,0,0.03");
  ASSERT_TRUE(desk_.session().files().save(folder_ / "my_0.1.scene.yaml").ok);
  for (int i = 0; i < 2; ++i) desk_.key(Key::f12);
  EXPECT_TRUE(there(folder_ / "my_0.1_001.png"));
  EXPECT_TRUE(there(folder_ / "my_0.1_002.png"));
}

TEST_F(NewHands, WhatComesWithTheProgramGetsNoFilesBesideIt) {
  desk_.open(scene_file("falling_fruit.scene.yaml"));
  EXPECT_EQ(ui().output_stem(), std::filesystem::current_path() / "falling_fruit");
}

TEST_F(NewHands, AnExportAsksWhereAndBeforeItWritesOver) {
  run("new plant herb");
  run("draw stem herb stem 0,0,0;0,0,0.3 0.004");
  const auto file = folder_ / "skeleton.csv";
  for (int time = 0; time < 2; ++time) {
    ui().ask_export("herb", ".csv");
    desk_.frames(4);
    desk_.key(Key::a, true);
    desk_.type((folder_ / "skeleton").string() + (time ? ".csv" : ""));
    desk_.key(Key::enter);
    desk_.settle();
    ASSERT_TRUE(there(file)) << "the ending is added";
    if (time == 0) io::write_file_atomically(file, "precious");
  }
  ASSERT_EQ(ui().dialog, Dialog::overwrite);
  EXPECT_EQ(io::read_file(file), "precious");
  press("Write over", "Write over it");
  EXPECT_THAT(io::read_file(file), HasSubstr("parentid"));
}

}  // namespace
}  // namespace pedicel::app
