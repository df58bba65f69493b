#include "app/view/view_camera.h"

#include <gtest/gtest.h>

namespace pedicel::app {
namespace {

constexpr int width = 800, height = 600;

render::Camera start() {
  render::Camera camera;
  camera.eye = Vec3(2, -1, 1.2);
  camera.target = Vec3(0.1, 0.2, 0.4);
  return camera;
}

TEST(ViewCamera, TakesOverACameraExactly) {
  const render::Camera taken = ViewCamera(start()).camera();
  EXPECT_LT((taken.eye - start().eye).norm(), 1e-12);
  EXPECT_LT((taken.target - start().target).norm(), 1e-12);
}

TEST(ViewCamera, TurningKeepsTargetAndDistance) {
  ViewCamera view(start());
  view.orbit(120, -45, height);
  EXPECT_EQ(view.target(), start().target);
  EXPECT_NEAR((view.camera().eye - view.target()).norm(), (start().eye - start().target).norm(),
              1e-12);
  EXPECT_GT((view.camera().eye - start().eye).norm(), 0.3);
}

TEST(ViewCamera, NeverTurnsOverTheTop) {
  ViewCamera view(start());
  view.orbit(0, 1e5, height);
  EXPECT_GT(view.camera().view()(1, 2), 0.0);  // up is still up in the picture
}

TEST(ViewCamera, PanningKeepsTheTargetUnderThePointer) {
  ViewCamera view(start());
  const Vec3 held = view.target();
  view.pan(37, -21, height);
  const render::PixelPoint p = view.camera().project(held, width, height);
  EXPECT_NEAR(p.x, 0.5 * width + 37, 1e-6);
  EXPECT_NEAR(p.y, 0.5 * height - 21, 1e-6);
}

TEST(ViewCamera, DollyKeepsThePlaceUnderThePointer) {
  ViewCamera view(start());
  const Vec3 place(0.3, 0.4, 0.6);
  const render::PixelPoint before = view.camera().project(place, width, height);
  view.dolly(3.0, place);
  const render::PixelPoint after = view.camera().project(place, width, height);
  EXPECT_NEAR(after.x, before.x, 1e-6);
  EXPECT_NEAR(after.y, before.y, 1e-6);
  EXPECT_LT(after.depth, 0.75 * before.depth);
}

TEST(ViewCamera, FramesABoxFromWhereItIs) {
  ViewCamera view(start());
  Eigen::AlignedBox3d box(Vec3(-0.2, -0.1, 0), Vec3(0.3, 0.2, 0.9));
  view.frame(box, static_cast<double>(width) / height);
  double widest = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    const render::PixelPoint p = view.camera().project(corner, width, height);
    EXPECT_TRUE(p.x > 0 && p.x < width && p.y > 0 && p.y < height);
    widest = std::max(widest, std::max(std::abs(p.x / width - 0.5), std::abs(p.y / height - 0.5)));
  }
  EXPECT_GT(widest, 0.4) << "the box fills the picture";
}

}  // namespace
}  // namespace pedicel::app
