#include "engine/render/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/core/random.h"

namespace pedicel::render {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

TEST(Camera, TargetIsInTheMiddleAtItsDistance) {
  const Camera camera{Vec3(1, 2, 3), Vec3(1, 5, 7)};
  const PixelPoint p = camera.project(camera.target, 640, 480);
  EXPECT_NEAR(p.x, 320.0, 1e-9);
  EXPECT_NEAR(p.y, 240.0, 1e-9);
  EXPECT_NEAR(p.depth, 5.0, 1e-12);
}

// Pinhole: a point x to the right and z up, at depth d, falls f x / d right of and f z / d above
// the middle, with f = (height / 2) / tan(field / 2).
TEST(Camera, ProjectsAsAPinhole) {
  Camera camera{Vec3(0, -4, 0), Vec3::Zero()};
  camera.field_of_view = 2.0 * std::atan(0.5);  // f = height
  const PixelPoint p = camera.project(Vec3(0.2, 0.0, 0.1), 800, 400);
  EXPECT_NEAR(p.x, 400.0 + 400.0 * 0.2 / 4.0, 1e-9);
  EXPECT_NEAR(p.y, 200.0 - 400.0 * 0.1 / 4.0, 1e-9);
}

TEST(Camera, UnprojectGoesBackThroughTheProjectedPoint) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Camera camera{random_point(random, 3.0), random_point(random, 1.0)};
    const Vec3 point = random_point(random, 1.0);
    const PixelPoint pixel = camera.project(point, 640, 360);
    if (pixel.depth < 0.1) continue;
    const geometry::Ray ray = camera.unproject(pixel.x, pixel.y, 640, 360);
    EXPECT_LT((point - ray.origin).cross(ray.direction).norm(), 1e-9);
  }
}

TEST(Camera, MatricesAgreeWithProject) {
  Random random(2);
  const Camera camera{Vec3(2, -1, 1.5), Vec3(0.1, 0.2, 0.3)};
  for (int i = 0; i < 50; ++i) {
    const Vec3 point = random_point(random, 0.5);
    const Eigen::Vector4d clip = camera.projection(2.0) * camera.view() * point.homogeneous();
    const PixelPoint pixel = camera.project(point, 400, 200);
    EXPECT_NEAR(200.0 * (1.0 + clip.x() / clip.w()), pixel.x, 1e-9);
    EXPECT_NEAR(100.0 * (1.0 - clip.y() / clip.w()), pixel.y, 1e-9);
    EXPECT_NEAR(clip.w(), pixel.depth, 1e-12);
  }
}

TEST(Camera, FramedBoxFillsThePictureAndStaysInside) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Eigen::AlignedBox3d box(random_point(random, 5.0));
    box.extend(random_point(random, 5.0));
    const int width = random.integer(200, 2000), height = random.integer(200, 2000);
    const Camera camera = frame(box, static_cast<double>(width) / height, random.uniform(-3, 3),
                                random.uniform(-1.4, 1.4));
    double widest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const PixelPoint p = camera.project(
          box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)), width, height);
      EXPECT_GT(p.depth, camera.near_plane);
      widest =
          std::max({widest, std::abs(2.0 * p.x / width - 1.0), std::abs(2.0 * p.y / height - 1.0)});
    }
    EXPECT_LE(widest, 1.0);
    EXPECT_GT(widest, 0.6);
  }
}

TEST(Camera, LookingStraightDownHasAPicture) {
  const Camera camera{Vec3(0, 0, 2), Vec3::Zero()};
  const PixelPoint a = camera.project(Vec3(0.1, 0, 0), 100, 100);
  const PixelPoint b = camera.project(Vec3(0, 0.1, 0), 100, 100);
  EXPECT_GT(std::hypot(a.x - b.x, a.y - b.y), 1.0);
}

TEST(Camera, RefusesWhatGivesNoPicture) {
  Camera camera;
  camera.eye = camera.target;
  EXPECT_THAT([&] { check(camera); }, ThrowsMessage<UsageError>(HasSubstr("coincide")));
  camera = {};
  camera.field_of_view = 3.2;
  EXPECT_THAT([&] { check(camera); },
              ThrowsMessage<UsageError>(HasSubstr("rad: must be between 0 and pi")));
  camera = {};
  camera.near_plane = 0.0;
  EXPECT_THAT([&] { check(camera); }, ThrowsMessage<UsageError>(HasSubstr("near_plane")));
}

}  // namespace
}  // namespace pedicel::render
