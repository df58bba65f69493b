#include <gtest/gtest.h>

#include "app/tools/drawn_shape.h"

namespace pedicel::app {
namespace {

TEST(Taper, RadiiChangeBetweenTheTwoPlaces) {
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 2), Vec3(0, 0, 4)};
  const std::vector<double> radii = taper_radii(points, 4.0, 2.0, 0.25, 0.75);
  EXPECT_EQ(radii, (std::vector<double>{4.0, 4.0, 3.0, 2.0}));
}

TEST(Taper, AStrokeWithoutExtentIsNoStem) {
  EXPECT_FALSE(shape_of({{Vec3::Zero(), 1.0}, {Vec3::Zero(), 1.0}}, {}));
}

TEST(Taper, AStrokeIsAsManyTimesAsThickAsItsSamplesSay) {
  std::vector<plant::StrokeSample> stroke;
  for (int i = 0; i <= 60; ++i) stroke.push_back({Vec3(0, 0, 0.01 * i), i < 30 ? 1.0 : 3.0});
  DrawMode options;
  options.radius_min = options.radius_max = 0.002;
  const auto shape = shape_of(stroke, options);
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->radius.front(), 0.002, 1e-9);
  EXPECT_NEAR(shape->radius.back(), 0.006, 1e-9);
}

}  // namespace
}  // namespace pedicel::app
