// Every panel is drawn off screen in several windows, and must show something, and whole words.
#include <map>

#include "app/editors/stem_editor.h"
#include "app/editors/tie_editor.h"
#include "app/ui/theme.h"
#include "tests/app/cut_text.h"
#include "tests/app/desk.h"

namespace pedicel::app {
namespace {

struct Look {
  int width, height;
  double scale;
  Theme theme;
};

std::ostream& operator<<(std::ostream& out, const Look& look) {
  return out << look.width << "x" << look.height << " scale " << look.scale
             << (look.theme == Theme::dark ? " dark" : " light");
}

class Panels : public ::testing::TestWithParam<Look> {
 protected:
  void SetUp() override {
    const Look look = GetParam();
    desk_ = std::make_unique<Desk>(look.width, look.height, look.scale);
    if (!desk_->available()) GTEST_SKIP() << desk_->why();
    desk_->ui().preferences.theme = look.theme;
    desk_->draw_coarsely();
    desk_->open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  }

  /// Fails with the picture kept where letters are cut or a panel is empty.
  void check(const std::string& what, const ImGuiWindow* window) {
    const auto cut = cut_letters();
    EXPECT_TRUE(cut.empty()) << what << ": " << cut.size() << " letters are cut:\n"
                             << describe(cut) << keep(what);
    for (const auto& [name, px] : overflowing())
      ADD_FAILURE() << what << ": " << name << " is too narrow by " << px << " px\n" << keep(what);
    ASSERT_NE(window, nullptr) << what << " is not there";
    EXPECT_GT(drawn_share(desk_->picture(), window->InnerRect), 0.01) << what << " is empty\n"
                                                                      << keep(what);
  }
  std::string keep(const std::string& what) {
    const std::string path = ::testing::TempDir() + "/panel_" + what + ".png";
    render::write_png(path, desk_->picture());
    return "picture: " + path;
  }

  std::unique_ptr<Desk> desk_;
};

TEST_P(Panels, ShowSomethingAndNoLetterIsCut) {
  // Numbers for the plots and the events.
  desk_->session().control().run_for(3.2);
  desk_->settle();
  for (const auto& panel : desk_->desktop().layout().panels()) {
    const std::string name(panel->name());
    desk_->show(name);
    const char* dock = panel->dock() == Dock::left    ? "left"
                       : panel->dock() == Dock::right ? "right"
                                                      : "bottom";
    check(name, panel_window(dock, name));
  }
}

TEST_P(Panels, DetailsOfWhatIsChosen) {
  desk_->show("Plants");
  for (const char* kind : {"element", "fruit", "link"}) {
    Selection& s = desk_->ui().selection;
    s = {};
    s.plant = 0, s.element = 3, s.fruit = 2, s.link = 4;
    s.kind = std::string(kind) == "element" ? Selection::Kind::element
             : std::string(kind) == "fruit" ? Selection::Kind::fruit
                                            : Selection::Kind::link;
    desk_->frames(4);
    check(std::string("details of ") + kind, panel_window("left", "Plants"));
  }
}

TEST_P(Panels, DetailsOfAStemAndItsPoints) {
  desk_->ui().draw.on = true;
  Selection& s = desk_->ui().selection;
  for (const char* part : {"stem", "point", "to_tip", "leaf", "tie"}) {
    s = {};
    choose_curve(desk_->ui(), "truss", "stem");
    if (part == std::string("point")) s.kind = Selection::Kind::curve_point, s.point = 1;
    if (part == std::string("leaf")) choose_leaf(desk_->ui(), "truss", "leaf_1");
    if (part == std::string("to_tip"))
      s = {}, s.kind = Selection::Kind::element, s.plant = 0, s.element = 3, s.to_tip = true;
    if (part == std::string("tie")) {
      ASSERT_TRUE(desk_->session().run_text("add tie truss/stem to=0.2,0,1 length=0.8").ok);
      desk_->settle();
      choose_tie(desk_->ui(), 0);
    }
    desk_->show("Plants");
    check(std::string("details of ") + part, panel_window("left", "Plants"));
  }
}

TEST_P(Panels, DrawOptionsOfEveryThing) {
  for (const DrawThing thing :
       {DrawThing::stem, DrawThing::fruit, DrawThing::leaf, DrawThing::trim, DrawThing::tie}) {
    desk_->ui().draw.thing = thing;
    desk_->ui().draw.on = true;
    desk_->show("Draw");
    check("draw" + std::to_string(static_cast<int>(thing)), panel_window("left", "Draw"));
  }
}

TEST_P(Panels, DialogsAndLegends) {
  for (const Dialog dialog : {Dialog::help, Dialog::info, Dialog::open, Dialog::unsaved,
                              Dialog::save_as, Dialog::overwrite, Dialog::add_robot}) {
    desk_->ui().dialog = dialog;
    desk_->frames(4);
    // In a narrow window one sidebar gives way to the other.
    const ImGuiWindow* side = panel_window("left", "");
    check("dialog" + std::to_string(static_cast<int>(dialog)),
          side ? side : panel_window("right", ""));
  }
  desk_->ui().dialog = Dialog::none;
  for (const ColourMap map : {ColourMap::strain, ColourMap::margin, ColourMap::contact}) {
    desk_->ui().view.colours = map;
    desk_->show("View");
    check("colours" + std::to_string(static_cast<int>(map)), panel_window("right", "View"));
  }
}

INSTANTIATE_TEST_SUITE_P(Looks, Panels,
                         ::testing::Values(Look{1280, 720, 1.0, Theme::dark},
                                           Look{1600, 900, 1.25, Theme::light},
                                           Look{2560, 1440, 2.0, Theme::dark},
                                           Look{1280, 720, 2.0, Theme::dark}));

// Pointed at from the left to the right, every item is met in turn, with a gap before the next.
TEST(Toolbar, FitsIntoANarrowWindow) {
  for (const auto& [width, scale] : {std::pair{1280, 2.0}, {1280, 1.0}}) {
    Desk desk(width, 720, scale);
    if (!desk.available()) GTEST_SKIP() << desk.why();
    desk.open_empty();
    std::vector<ImGuiID> met{0};
    for (double x = 2; x < width; x += 3.0 * scale) {
      desk.send(InputEvent::move(x, 17.0 * scale));
      desk.frames(1);
      if (const ImGuiID id = ImGui::GetHoveredID(); met.back() != id) met.push_back(id);
    }
    int items = 0;
    for (std::size_t i = 1; i < met.size(); ++i) {
      items += met[i] != 0;
      EXPECT_TRUE(met[i] == 0 || met[i - 1] == 0) << "one covers another at scale " << scale;
    }
    EXPECT_EQ(items, 17) << "scale " << scale;
  }
}

TEST(CutText, IsSeen) {
  Desk desk(640, 480);
  if (!desk.available()) GTEST_SKIP() << desk.why();
  desk.frames(2);
  const auto draw = [](float width) {
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(ImVec2(10, 10));
    ImGui::SetNextWindowSize(ImVec2(width, 100));
    ImGui::Begin("words", nullptr, ImGuiWindowFlags_NoDecoration);
    ImGui::TextUnformatted("a line of words that is long");
    ImGui::End();
    ImGui::Render();
    return cut_letters().size() + overflowing().size();
  };
  EXPECT_EQ(draw(400), 0u);
  EXPECT_EQ(draw(400), 0u);
  draw(90);
  EXPECT_GT(draw(90), 0u);
}

TEST(DrawnShare, IsZeroForAnEmptyPart) {
  render::Image image(40, 40);
  EXPECT_EQ(drawn_share(image, ImRect(0, 0, 40, 40)), 0.0);
  image.at(3, 3)[0] = 255;
  EXPECT_GT(drawn_share(image, ImRect(0, 0, 40, 40)), 0.0);
}

}  // namespace
}  // namespace pedicel::app
