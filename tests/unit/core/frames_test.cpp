#include "engine/core/frames.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace pedicel {
namespace {

Vec3 random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

Pose random_pose(Random& random) {
  const Quat q(random.normal(), random.normal(), random.normal(), random.normal());
  return {random_vector(random), q.normalized()};
}

TEST(Pose, ComposesAndInverts) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Pose a = random_pose(random), b = random_pose(random);
    const Vec3 p = random_vector(random);
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-12);
    EXPECT_LT((a.inverse() * (a * p) - p).norm(), 1e-12);
    EXPECT_NEAR((a * b).rotation.norm(), 1.0, 1e-15);
  }
}

// A quarter turn about Z takes X into Y; then the pose's position is added.
TEST(Pose, KnownTurn) {
  const Pose pose{Vec3(1, 2, 3), Quat(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitZ()))};
  EXPECT_LT((pose * Vec3::UnitX() - Vec3(1, 3, 3)).norm(), 1e-15);
}

TEST(Skew, IsTheCrossProduct) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Vec3 a = random_vector(random), b = random_vector(random);
    EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace pedicel
