#include "engine/geometry/shapes.h"

#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "tests/unit/geometry/sdf_property.h"

namespace pedicel::geometry {
namespace {

std::vector<std::shared_ptr<const SignedDistance>> solids() {
  return {std::make_shared<SphereDistance>(0.6), std::make_shared<BoxDistance>(Vec3(0.8, 1.0, 1.4)),
          std::make_shared<CylinderDistance>(0.4, 1.2), std::make_shared<CapsuleDistance>(0.3, 0.9),
          std::make_shared<PlaneDistance>(Vec3(1, -2, 3), 0.2)};
}

TEST(Shapes, AreExactDistances) {
  Random random(11);
  for (const auto& solid : solids()) expect_exact_distance(*solid, random, 1.2);
}

TEST(Shapes, PlacedShapesAreExactDistances) {
  Random random(12);
  for (const auto& solid : solids()) {
    Pose pose = random_pose(random);
    pose.position *= 0.3;
    const PlacedDistance placed(solid, pose);
    expect_exact_distance(placed, random, 1.2);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = random_point(random, 1);
      Vec3 here, there;
      EXPECT_NEAR(placed.distance(pose * p, &there), solid->distance(p, &here), 1e-12);
      EXPECT_LT((there - pose.rotation * here).norm(), 1e-12);
    }
  }
}

TEST(Shapes, KnownDistances) {
  EXPECT_DOUBLE_EQ(SphereDistance(1).distance({0, 3, 4}), 4.0);
  EXPECT_DOUBLE_EQ(BoxDistance({2, 4, 6}).distance({4, 6, 3}), 5.0);
  EXPECT_DOUBLE_EQ(BoxDistance({2, 4, 6}).distance({0.5, 0, 0}), -0.5);
  EXPECT_DOUBLE_EQ(CylinderDistance(1, 4).distance({4, 0, 6}), 5.0);
  EXPECT_DOUBLE_EQ(CylinderDistance(1, 4).distance({0, 0, 1.5}), -0.5);
  EXPECT_DOUBLE_EQ(CapsuleDistance(1, 4).distance({0, 3, 6}), 4.0);
  EXPECT_DOUBLE_EQ(PlaneDistance({0, 0, 2}, 1).distance({7, 8, 3}), 2.0);
}

TEST(Shapes, HaveAUnitGradientWhereItJumps) {
  for (const auto& solid : solids()) {
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.4, 0.5, 0.7), Vec3(0.4, 0, 0.6), Vec3(0, 0, 5)}) {
      Vec3 gradient;
      solid->distance(p, &gradient);
      EXPECT_NEAR(gradient.norm(), 1.0, 1e-12);
    }
  }
}

TEST(Shapes, RefuseSizesThatAreNotPositive) {
  EXPECT_THROW(SphereDistance(0), UsageError);
  EXPECT_THROW(BoxDistance({1, -1, 1}), UsageError);
  EXPECT_THROW(CylinderDistance(1, NAN), UsageError);
  EXPECT_THROW(CapsuleDistance(-1, 1), UsageError);
  EXPECT_THROW(PlaneDistance(Vec3::Zero()), UsageError);
  EXPECT_THROW(PlacedDistance(nullptr, Pose{}), UsageError);
}

}  // namespace
}  // namespace pedicel::geometry
