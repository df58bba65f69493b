#include "app/view/picking.h"

#include <gtest/gtest.h>

namespace pedicel::app {
namespace {

const geometry::Ray along_x{Vec3(-1, 0, 0), Vec3(1, 0, 0)};

TEST(Picking, ASphereIsHitAtItsNearSide) {
  EXPECT_NEAR(hit_sphere(along_x, Vec3(2, 0.3, 0), 0.5), 3 - 0.4, 1e-12);
  EXPECT_LT(hit_sphere(along_x, Vec3(2, 0.6, 0), 0.5), 0.0);
  EXPECT_LT(hit_sphere(along_x, Vec3(-3, 0, 0), 0.5), 0.0) << "behind the eye";
}

TEST(Picking, TheNearestPlaceOfAnAxis) {
  const NearAxis near = near_axis(along_x, Vec3(1, -1, 0.25), Vec3(1, 3, 0.25));
  EXPECT_NEAR(near.along, 0.25, 1e-12);
  EXPECT_NEAR(near.gap, 0.25, 1e-12);
  EXPECT_NEAR(near.distance, 2.0, 1e-12);
  EXPECT_NEAR(near_axis(along_x, Vec3(1, 2, 0), Vec3(1, 3, 0)).along, 0.0, 1e-12);
}

TEST(Picking, ATriangleInsideAndOutside) {
  const Vec3 a(1, -1, -1), b(1, 1, -1), c(1, 0, 1);
  EXPECT_NEAR(hit_triangle(along_x, a, b, c), 2.0, 1e-12);
  EXPECT_LT(hit_triangle({Vec3(-1, 0.9, 0.5), Vec3(1, 0, 0)}, a, b, c), 0.0);
}

}  // namespace
}  // namespace pedicel::app
