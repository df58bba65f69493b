#include <gtest/gtest.h>

#include "app/window/drawn_shape.h"

namespace pedicel::app {
namespace {

TEST(Taper, RadiiChangeBetweenTheTwoPlaces) {
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 2), Vec3(0, 0, 4)};
  const std::vector<double> radii = taper_radii(points, 4.0, 2.0, 0.25, 0.75);
  EXPECT_EQ(radii, (std::vector<double>{4.0, 4.0, 3.0, 2.0}));
}

TEST(Taper, AStrokeWithoutExtentIsNoStem) {
  EXPECT_FALSE(shape_of({Vec3::Zero(), Vec3::Zero()}, {}));
}

}  // namespace
}  // namespace pedicel::app
