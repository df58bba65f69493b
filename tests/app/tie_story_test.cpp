// The story of a string: a wire and a stem are there, a string is dragged from one to the other,
// made shorter in numbers, pulls, is saved with the scene, read again and taken away.
#include "app/editors/tie_editor.h"
#include "tests/app/empty_desk.h"

namespace pedicel::app {
namespace {

class TieStory : public EmptyDesk {
 protected:
  const std::vector<world::SceneTie>& ties() { return scene().ties; }
  double tension() {
    const auto now = desk_.snapshot();
    return now->ties.empty() ? -1.0 : now->ties.front().course.tension;
  }
};

TEST_F(TieStory, AStemHangsFromAWire) {
  run("new plant wire");
  run("draw stem wire wire -0.25,0,0.5;0,0,0.5;0.25,0,0.5 0.002");
  run("add support wire wire 1");
  run("set material wire youngs_modulus 2e10");
  run("new plant herb");
  run("draw stem herb stem 0.05,0,0;0.05,0,0.15;0.05,0,0.3 0.004");
  desk_.key(Key::home);
  desk_.key(Key::d);
  ui().draw.thing = DrawThing::tie;
  const ImVec2 stem = desk_.at(Vec3(0.05, 0, 0.28)), wire = desk_.at(Vec3(0.1, 0, 0.5));
  desk_.drag({stem, ImVec2(0.5F * (stem.x + wire.x), 0.5F * (stem.y + wire.y)), wire});
  desk_.settle();
  ASSERT_EQ(ties().size(), 1U) << ui().notice;
  EXPECT_EQ(ties()[0].organ, "herb/stem");
  EXPECT_NEAR(ties()[0].at, 0.28 / 0.3, 0.03);
  EXPECT_EQ(ties()[0].to_organ, "wire/wire");
  ASSERT_TRUE(ties()[0].to_at);
  EXPECT_NEAR(*ties()[0].to_at, 0.7, 0.03);
  EXPECT_EQ(ui().selection.kind, Selection::Kind::tie);
  EXPECT_NEAR(tension(), 0.0, 1e-9) << "as long as drawn";

  // Shorter than drawn it pulls the stem towards the wire.
  desk_.key(Key::d);
  run("set tie 1 length 0.2");
  run("run 1");
  EXPECT_GT(tension(), 0.05);
  const auto height = [&] { return desk_.snapshot()->plants[0].state.position.front().z(); };
  EXPECT_LT(height(), 0.5) << "the wire bends";

  run("save " + (folder_ / "hung.scene.yaml").string());
  run("open " + (folder_ / "hung.scene.yaml").string());
  ASSERT_EQ(ties().size(), 1U);
  EXPECT_EQ(ties()[0].to_organ, "wire/wire");
  EXPECT_EQ(ties()[0].length.value(), 0.2);
  choose_tie(ui(), 0);
  desk_.key(Key::del);
  desk_.settle();
  EXPECT_TRUE(ties().empty());
  EXPECT_TRUE(desk_.snapshot()->ties.empty());
  desk_.key(Key::z, true);
  desk_.settle();
  EXPECT_EQ(ties().size(), 1U);
  EXPECT_EQ(desk_.snapshot()->ties.size(), 1U);
}

}  // namespace
}  // namespace pedicel::app
