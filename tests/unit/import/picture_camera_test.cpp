// A camera's pixels, back to the plane in which the points moved.
#include "plugins/discrepancy/import/picture_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

/// 1 m in front of the plane y = 0, looking along +y, x to the right and z up in the picture.
PictureCamera camera() {
  PictureCamera made;
  Mat3 turn;
  turn.col(0) = Vec3::UnitX();
  turn.col(1) = -Vec3::UnitZ();
  turn.col(2) = Vec3::UnitY();
  made.pose = {Vec3(0.1, -1, 0.3), Quat(turn)};
  made.focal = {900, 800};
  made.centre = {640, 360};
  return made;
}

/// The pixel of a point, through Brown's model as its author gives it.
Eigen::Vector2d pixel_of(const PictureCamera& c, const Vec3& point) {
  const Vec3 p = c.pose.inverse() * point;
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const auto& d = c.distortion;
  const double radial = 1 + d[0] * r2 + d[1] * r2 * r2 + d[4] * r2 * r2 * r2;
  const double u = x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x);
  const double v = y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y;
  return {c.focal.x() * u + c.centre.x(), c.focal.y() * v + c.centre.y()};
}

TEST(PictureCamera, FindsPointsInThePlane) {
  PictureCamera c = camera();
  const PicturePlane plane{1, 0.05};
  for (const bool bent : {false, true}) {
    if (bent) c.distortion = {-0.2, 0.05, 0.001, -0.002, 0.01};
    for (const Vec3& point : {Vec3(0.1, 0.05, 0.3), Vec3(0.4, 0.05, 0.6), Vec3(-0.3, 0.05, 0.0)}) {
      const auto ray = c.ray(pixel_of(c, point));
      ASSERT_TRUE(ray);
      const auto found = plane.meets(c.pose.position, *ray);
      ASSERT_TRUE(found);
      EXPECT_NEAR((*found - point).norm(), 0.0, 1e-8);
    }
  }
  EXPECT_FALSE((PicturePlane{1, -2.0}.meets(c.pose.position, Vec3::UnitY())));  // behind
  EXPECT_FALSE(plane.meets(c.pose.position, Vec3::UnitX()));                    // along it
}

TEST(PictureCamera, RefusesAPictureThatFolds) {
  PictureCamera c = camera();
  c.distortion = {-5, 0, 0, 0, 0};
  EXPECT_FALSE(c.ray({640 + 900, 360}));
}

TEST(PictureCamera, ReadsAFileAndSaysWhatIsWrong) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text, std::string& faults) {
    io::write_file_atomically(folder / "camera.yaml", text);
    Diagnostics diagnostics;
    const auto found = read_picture_camera(folder / "camera.yaml", diagnostics);
    faults = diagnostics.text();
    return found;
  };
  std::string faults;
  const std::string good =
      "{\"position\": [1, 2, 3], \"orientation\": [0, 0, 0, 2], \"focal\": [900, 901],\n"
      " \"centre\": [640, 360], \"size\": [1280, 720]";
  const auto found = read(good + ", \"distortion\": [0.1, 0, 0, 0, 0]}", faults);
  ASSERT_TRUE(found) << faults;
  EXPECT_EQ(found->focal, Eigen::Vector2d(900, 901));
  EXPECT_EQ(found->pose.position, Vec3(1, 2, 3));
  EXPECT_EQ(found->distortion[0], 0.1);
  EXPECT_FALSE(read(good + ", \"distortion\": [0.1]}", faults));
  EXPECT_THAT(faults, HasSubstr("camera.yaml:2:59: error: distortion has 1 numbers"));
  EXPECT_FALSE(read(good + ", \"fov\": 50}", faults));
  EXPECT_THAT(faults, HasSubstr("fov"));
  EXPECT_FALSE(read(
      "{position: [1, 2, 3], orientation: [0, 0, 0, 1], focal: [900], centre: [1, 2]}", faults));
  EXPECT_THAT(faults, HasSubstr("focal has 1 numbers"));
  EXPECT_FALSE(read("{}", faults));
  EXPECT_THAT(faults, HasSubstr("position"));
}

TEST(PicturePlane, ReadsItsWords) {
  const PicturePlane plane = plane_of_text("y=-0.02", "--plane");
  EXPECT_EQ(plane.axis, 1);
  EXPECT_EQ(plane.offset, -0.02);
  for (const char* text : {"", "y", "y=", "w=1", "y=one"})
    EXPECT_THROW(plane_of_text(text, "--plane"), UsageError) << text;
}

}  // namespace
}  // namespace pedicel::discrepancy
