// The whole story off screen: a stem and a branch are drawn, a fruit is put on, pulled off, and all
// of it is undone, saved and read again.
#include "app/session/session_files.h"
#include "tests/app/desk.h"

namespace pedicel::app {
namespace {

const plant::PlantFile* only_plant(Desk& desk) {
  const auto& plants = desk.session().document().plants;
  return plants.empty() ? nullptr : plants.front().file.get();
}

TEST(Story, DrawPullUndoSaveReload) {
  Desk desk;
  if (!desk.available()) GTEST_SKIP() << desk.why();
  desk.draw_coarsely();
  desk.session().files().open_empty();
  desk.settle();
  desk.key(Key::d);
  ASSERT_TRUE(desk.ui().draw.on);

  // A stem from the ground up.
  std::vector<ImVec2> way;
  for (int i = 0; i <= 8; ++i) way.push_back(desk.at(Vec3(0.002 * i, 0, 0.05 * i)));
  desk.drag(way);
  desk.settle();
  ASSERT_NE(only_plant(desk), nullptr);
  ASSERT_EQ(only_plant(desk)->curves.size(), 1u);
  EXPECT_EQ(desk.snapshot()->plants.size(), 1u) << "it is simulated at once";

  // A branch from its middle; the snap is there before the button goes down.
  const ImVec2 from = desk.at(Vec3(0.009, 0, 0.22));
  desk.move(from.x, from.y);
  EXPECT_EQ(desk.ui().hover.kind, Selection::Kind::element);
  desk.drag({from, ImVec2(from.x + 30, from.y - 12), ImVec2(from.x + 60, from.y - 18),
             ImVec2(from.x + 90, from.y - 20)});
  desk.settle();
  ASSERT_EQ(only_plant(desk)->curves.size(), 2u) << desk.ui().notice;
  EXPECT_EQ(desk.session().document().plants.size(), 1u) << "a branch, no plant of its own";

  // A fruit near the branch's tip.
  desk.ui().draw.thing = DrawThing::fruit;
  desk.ui().draw.fruit_stretch = 0.03;
  desk.click(from.x + 84, from.y - 19);
  desk.settle();
  ASSERT_EQ(only_plant(desk)->fruits.size(), 1u);
  EXPECT_EQ(only_plant(desk)->fruits[0].place.curve, only_plant(desk)->curves[1].name);
  desk.key(Key::escape);
  EXPECT_FALSE(desk.ui().draw.on);

  // Ctrl+drag pulls it off.
  const auto place = [&] {
    const auto s = desk.snapshot();
    const cosserat::Fruit& fruit = s->plants[0].model->fruits[0];
    return point_on(*s->plants[0].model, s->plants[0].state, fruit.element, fruit.back);
  };
  const ImVec2 at = desk.at(place());
  desk.ui().preferences.pull_stiffness = 500;
  desk.move(at.x, at.y);
  desk.hold(Key::left_control, true);
  desk.button(0, true);
  for (int i = 1; i <= 10 && desk.snapshot()->events->empty(); ++i) {
    desk.move(at.x + 25 * i, at.y - 10 * i);
    desk.session().control().run_for(0.3);
    desk.settle();
  }
  desk.button(0, false);
  desk.hold(Key::left_control, false);
  EXPECT_EQ(desk.snapshot()->events->size(), 1u) << "the fruit came off";

  // Undo and redo by keys: first the pull, which came last, then the fruit.
  const auto drawn = desk.session().document().state_hash();
  desk.key(Key::z, true);
  desk.settle();
  EXPECT_TRUE(desk.snapshot()->events->empty()) << "it hangs again";
  EXPECT_EQ(desk.session().document().state_hash(), drawn);
  desk.key(Key::z, true);
  EXPECT_TRUE(only_plant(desk)->fruits.empty());
  desk.key(Key::z, true, true);
  EXPECT_EQ(desk.session().document().state_hash(), drawn);

  // Save by the dialog, then read it again.
  const auto path = std::filesystem::path(::testing::TempDir()) / "story.plant.yaml";
  std::filesystem::remove(path);
  desk.key(Key::s, true);
  desk.frames(4);
  EXPECT_EQ(desk.ui().dialog, Dialog::save_as);
  desk.key(Key::a, true);
  desk.type(path.string());
  desk.key(Key::enter);
  desk.settle();
  ASSERT_TRUE(std::filesystem::exists(path));
  const plant::PlantFile saved = *only_plant(desk);
  desk.key(Key::r, true);
  desk.settle();
  ASSERT_NE(only_plant(desk), nullptr);
  EXPECT_TRUE(only_plant(desk)->curves == saved.curves);
  EXPECT_TRUE(only_plant(desk)->fruits == saved.fruits);
}

}  // namespace
}  // namespace pedicel::app
