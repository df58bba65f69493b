#include "engine/world/bodies.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/world/rigid_shape.h"

namespace pedicel::world {
namespace {

TEST(Bodies, ATrayIsItsOutsideSizeAndStandsOnItsOrigin) {
  BodyDescription tray;
  tray.parts = tray_parts({0.4, 0.3, 0.1}, 0.01);
  const auto [lower, upper] = bounds_of(tray);
  EXPECT_LT((lower - Vec3(-0.2, -0.15, 0)).norm(), 1e-12);
  EXPECT_LT((upper - Vec3(0.2, 0.15, 0.1)).norm(), 1e-12);
}

TEST(Bodies, AStubReachesFromTheFruitsSurfaceToItsEnd) {
  const BodyDescription body = fruit_body("fruit", 0.012, 0.007, 0.05, 0.0015);
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_NEAR(bounds_of(body).first.z(), -0.05 - 0.0015, 1e-12);
  EXPECT_NEAR(bounds_of(body).second.z(), 0.012, 1e-12);
}

TEST(Bodies, AStubInsideTheFruitIsLeftOut) {
  EXPECT_EQ(fruit_body("fruit", 0.012, 0.007, 0.01, 0.0015).parts.size(), 1u);
}

// Two cubes of edge a and mass m/2 with centres at +-d on X: I_x = 2 (m/2) a^2/6,
// I_y = I_z = that + m d^2 (parallel axes).
TEST(Bodies, InertiaOfTwoCubesIsTheClosedForm) {
  BodyDescription body;
  body.mass = 3.0;
  const double a = 0.1, d = 0.2;
  for (double x : {1.0 - d, 1.0 + d}) {
    BodyPart part;
    part.half_extents = Vec3::Constant(0.5 * a);
    part.pose.position = Vec3(x, 0, 0);
    body.parts.push_back(part);
  }
  const RigidShape shape = make_rigid_shape(body);
  const double own = 3.0 * a * a / 6.0, off = own + 3.0 * d * d;
  EXPECT_LT((shape.X_BC.position - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((shape.inertia - Vec3(own, off, off)).norm(), 1e-12);
}

// A rod turned by 45 degrees about Y: one principal moment stays small, the frame turns with it.
TEST(Bodies, PrincipalFrameFollowsATurnedPart) {
  BodyDescription body;
  body.mass = 1.0;
  BodyPart part;
  part.half_extents = Vec3(0.01, 0.02, 0.5);
  part.pose.rotation = Quat(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vec3::UnitY()));
  body.parts.push_back(part);
  const RigidShape shape = make_rigid_shape(body);
  EXPECT_NEAR(shape.inertia.minCoeff(), 1.0 / 3.0 * (0.01 * 0.01 + 0.02 * 0.02), 1e-12);
  EXPECT_NEAR(shape.inertia.maxCoeff(), 1.0 / 3.0 * (0.02 * 0.02 + 0.5 * 0.5), 1e-12);
}

}  // namespace
}  // namespace pedicel::world
