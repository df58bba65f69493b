#include "engine/geometry/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

constexpr int kSteps = 60;

// No sample of the brute force may be closer than the answer, and with spacing s between samples
// the best one is at most s farther.
TEST(ClosestPoint, SegmentsAgreeWithBruteForce) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a0 = random_point(random, 1), b0 = random_point(random, 1);
    Vec3 a1 = random_point(random, 1), b1 = random_point(random, 1);
    if (i % 5 == 1) b1 = b0 + (a1 - a0);            // parallel
    if (i % 5 == 2) b1 = b0 + 1e-9 * b1 + a1 - a0;  // nearly parallel
    if (i % 5 == 3) a1 = a0;                        // a point
    if (i % 10 == 3) b1 = b0;
    const SegmentPair pair = closest_on_segments(a0, a1, b0, b1);
    EXPECT_NEAR((pair.first - pair.second).norm(), pair.distance, 1e-14);
    EXPECT_LT((a0 + pair.s * (a1 - a0) - pair.first).norm(), 1e-14);
    EXPECT_LT((b0 + pair.t * (b1 - b0) - pair.second).norm(), 1e-14);
    EXPECT_TRUE(pair.s >= 0 && pair.s <= 1 && pair.t >= 0 && pair.t <= 1);
    double best = 1e9;
    for (int s = 0; s <= kSteps; ++s)
      for (int t = 0; t <= kSteps; ++t)
        best = std::min(
            best,
            (a0 + double(s) / kSteps * (a1 - a0) - b0 - double(t) / kSteps * (b1 - b0)).norm());
    EXPECT_LE(pair.distance, best + 1e-12);
    EXPECT_GE(pair.distance, best - ((a1 - a0).norm() + (b1 - b0).norm()) / kSteps);
  }
}

// The projection theorem decides convex problems: q is the nearest point of a convex set when no
// corner v of the set lies on p's side of q: (p - q) . (v - q) <= 0.
TEST(ClosestPoint, PointOnSegmentIsTheProjection) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(random, 1), a = random_point(random, 1);
    const Vec3 b = i % 10 ? random_point(random, 1) : a;
    const double t = closest_on_segment(p, a, b);
    const Vec3 q = a + t * (b - a);
    EXPECT_TRUE(t >= 0.0 && t <= 1.0);
    for (const Vec3& corner : {a, b}) EXPECT_LE((p - q).dot(corner - q), 1e-13);
  }
}

TEST(ClosestPoint, PointOnTriangleIsTheProjectionAndNamesItsFeature) {
  Random random(3);
  int seen[7] = {};
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random_point(random, 2), a = random_point(random, 1),
               b = random_point(random, 1);
    Vec3 c = random_point(random, 1);
    if (i % 10 == 1) c = a + random.uniform(-1, 2) * (b - a);  // no area
    if (i % 10 == 2) c = b;
    const TrianglePoint at = closest_on_triangle(p, a, b, c);
    for (const Vec3& corner : {a, b, c}) EXPECT_LE((p - at.point).dot(corner - at.point), 1e-12);
    // In the triangle: the three triangles with q add up to the area, or to nothing.
    const auto area = [](const Vec3& u, const Vec3& v, const Vec3& w) {
      return (v - u).cross(w - u).norm();
    };
    EXPECT_NEAR(area(at.point, a, b) + area(at.point, b, c) + area(at.point, c, a), area(a, b, c),
                1e-12);
    ++seen[static_cast<int>(at.feature)];
    const Vec3* corners[] = {&a, &b, &c};
    const int feature = static_cast<int>(at.feature);
    if (feature >= 4) {
      EXPECT_EQ(at.point, *corners[feature - 4]);
    }
    if (feature >= 1 && feature <= 3) {
      EXPECT_LT(area(at.point, *corners[feature - 1], *corners[feature % 3]), 1e-12);
    }
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace pedicel::geometry
