#pragma once

#include "engine/geometry/signed_distance.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {

/// What holds for every exact signed distance: a unit gradient that agrees with differences and
/// leads to the surface (d(p - d g) = 0, so the sign and the size are right together). Points near
/// the medial axis, where the gradient jumps, are told by d not being as smooth as it should.
inline void expect_exact_distance(const SignedDistance& solid, Random& random, double half) {
  int inside = 0, outside = 0, smooth = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, half);
    Vec3 gradient;
    const double d = solid.distance(p, &gradient);
    EXPECT_EQ(solid.distance(p), d);
    ASSERT_NEAR(gradient.norm(), 1.0, 1e-9);
    EXPECT_NEAR(solid.distance(p - d * gradient), 0.0, 1e-9);
    ++(d < 0 ? inside : outside);
    if (d < 0) {
      EXPECT_TRUE(solid.bounds().contains(p));
    }
    constexpr double kStep = 1e-6;
    Vec3 difference;
    for (int k = 0; k < 3; ++k)
      difference[k] =
          (solid.distance(p + kStep * Vec3::Unit(k)) - solid.distance(p - kStep * Vec3::Unit(k))) /
          (2 * kStep);
    if (std::abs(difference.norm() - 1.0) > 1e-4) continue;
    ++smooth;
    EXPECT_LT((difference - gradient).norm(), 2e-4);
    // 1-Lipschitz against a second point.
    const Vec3 other = random_point(random, half);
    EXPECT_LE(std::abs(solid.distance(other) - d), (other - p).norm() + 1e-12);
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
  EXPECT_GT(smooth, 1900);
}

}  // namespace pedicel::geometry
