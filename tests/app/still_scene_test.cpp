// What does not change is not drawn again; what is thin stays a line at the coarsest quality.
#include "app/view/list_key.h"
#include "tests/app/desk.h"

namespace pedicel::app {
namespace {

TEST(ListKey, IsAnotherForAnotherPicture) {
  render::DrawList list;
  const std::vector<render::TubePoint> tube = {{Vec3(0, 0, 0), 0.01, {}},
                                               {Vec3(0, 0, 1), 0.01, {}}};
  list.add_tube(tube);
  list.spheres.push_back({Vec3(1, 0, 0), 0.1, {}});
  list.lines.push_back({Vec3::Zero(), Vec3::UnitX(), {}, 1.0f});
  render::Camera camera;
  const std::uint64_t key = list_key(list, camera);
  EXPECT_EQ(list_key(list, camera), key);
  render::DrawList other = list;
  other.tubes[0].r0 = 0.011;
  EXPECT_NE(list_key(other, camera), key);
  other = list;
  other.spheres[0].material.colour.r = 0.1f;
  EXPECT_NE(list_key(other, camera), key);
  other = list;
  other.lines[0].width = 2.0f;
  EXPECT_NE(list_key(other, camera), key);
  camera.eye.x() += 1e-9;
  EXPECT_NE(list_key(list, camera), key);
}

class StillScene : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    canvas_ = std::make_unique<SceneCanvas>(*desk_.gl());
    quality_.automatic = false;
    quality_.level = CanvasQuality::coarsest;
    list_.ground.reset();
    camera_.eye = Vec3(0, -2, 0);
    const std::vector<render::TubePoint> tube = {{Vec3(-0.2, 0, -0.4), 0.0003, stem_},
                                                 {Vec3(0.2, 0, 0.4), 0.0003, stem_}};
    list_.add_tube(tube);
  }
  bool draw() { return canvas_->draw(list_, camera_, 300, 300, quality_, true); }

  Desk desk_{320, 320};
  std::unique_ptr<SceneCanvas> canvas_;
  render::DrawList list_;
  render::Camera camera_;
  CanvasQuality quality_;
  static constexpr render::Colour stem_ = render::Colour::hex(0x205010);
};

TEST_F(StillScene, IsNotDrawnAgain) {
  EXPECT_TRUE(draw());
  for (int i = 0; i < 60; ++i) EXPECT_FALSE(draw());
  camera_.eye.x() += 0.1;
  EXPECT_TRUE(draw());
  list_.tubes[0].p1.x() += 0.1;
  EXPECT_TRUE(draw());
  EXPECT_FALSE(draw());
}

TEST_F(StillScene, IsDrawnOnceAtItsBestAfterAMoment) {
  quality_.automatic = true;
  EXPECT_TRUE(draw());
  int drawn = 0;
  for (int i = 0; i < 100; ++i) drawn += draw() ? 1 : 0;
  EXPECT_EQ(drawn, 1);
}

TEST_F(StillScene, AThinStemIsALineWithoutGaps) {
  // Drawn by hand with and without: rows of the picture in which nothing of the stem is seen.
  const auto gaps = [&](double pixels) {
    render::RenderSettings settings = settings_of_level(CanvasQuality::coarsest);
    render::Renderer renderer(*desk_.gl(), settings);
    render::DrawList list = list_;
    if (pixels > 0.0) widen(list, camera_, 180, pixels);
    const render::Image image = renderer.render(list, camera_, 180, 180);
    int empty = 0;
    for (int y = 50; y < 130; ++y) {
      int darkest = 255;
      for (int x = 0; x < image.width; ++x) darkest = std::min<int>(darkest, image.at(x, y)[0]);
      empty += darkest > 140 ? 1 : 0;
    }
    return empty;
  };
  EXPECT_GT(gaps(0.0), 10) << "as it was: dots";
  EXPECT_EQ(gaps(least_width_of_level(CanvasQuality::coarsest)), 0);
}

TEST(StillWindow, IsPaintedAgainOnlyWhenItLooksOtherwise) {
  Desk desk;
  if (!desk.available()) GTEST_SKIP() << desk.why();
  desk.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
  desk.frames(60);
  const render::Image before = desk.picture();
  desk.frames(5);
  EXPECT_EQ(desk.picture().rgb, before.rgb);
  desk.show("Messages");
  desk.frames(3);
  EXPECT_NE(desk.picture().rgb, before.rgb) << "another panel is shown at once";
}

}  // namespace
}  // namespace pedicel::app
