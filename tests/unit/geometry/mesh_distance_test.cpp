#include "engine/geometry/mesh_distance.h"

#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/geometry/primitives_mesh.h"
#include "engine/geometry/shapes.h"
#include "tests/unit/geometry/sdf_property.h"

namespace pedicel::geometry {
namespace {

TEST(MeshDistance, IsAnExactDistance) {
  Random random(21);
  expect_exact_distance(MeshDistance(make_box({0.8, 1.0, 1.4})), random, 1.2);
  expect_exact_distance(MeshDistance(make_capsule(0.4, 0.8, 12)), random, 1.2);
  expect_exact_distance(MeshDistance(torus(0.7, 0.3, 24, 12)), random, 1.2);
}

TEST(MeshDistance, OfABoxMatchesTheFormulaUnderRandomMoves) {
  Random random(22);
  const Vec3 size(0.8, 1.0, 1.4);
  const BoxDistance box(size);
  for (int move = 0; move < 10; ++move) {
    const Pose pose = random_pose(random);
    const MeshDistance mesh(moved(make_box(size), pose));
    EXPECT_TRUE(mesh.given_topology().manifold());
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random_point(random, 1.2);
      EXPECT_NEAR(mesh.distance(pose * p), box.distance(p), 1e-12);
    }
  }
}

// The mesh's vertices lie on the torus; its flat facets are off (inside, or outside around the
// saddle) by at most the sagittas of both circles, r (1 - cos(pi/m)) + (R + r)(1 - cos(pi/n)).
TEST(MeshDistance, OfATorusMatchesTheFormulaWithinTheFacets) {
  Random random(23);
  constexpr double kMajor = 0.7, kMinor = 0.25;
  const MeshDistance mesh(torus(kMajor, kMinor, 96, 48));
  const double facet = kMinor * (1 - std::cos(std::numbers::pi / 48)) +
                       (kMajor + kMinor) * (1 - std::cos(std::numbers::pi / 96));
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, 1.2);
    const double exact = std::hypot(std::hypot(p.x(), p.y()) - kMajor, p.z()) - kMinor;
    EXPECT_NEAR(mesh.distance(p), exact, facet);
  }
}

TEST(MeshDistance, NearestAgreesWithBruteForceAndItsBoundIsKept) {
  Random random(24);
  const TriangleMesh mesh = torus(0.7, 0.25, 20, 10);
  const TriangleBvh bvh(mesh);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(random, 1.5);
    double best = 1e9;
    for (const auto& t : mesh.triangles)
      best = std::min(best, (p - closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                     mesh.vertices[t[2]])
                                     .point)
                                .norm());
    EXPECT_DOUBLE_EQ(std::sqrt(bvh.nearest(p).squared_distance), best);
    EXPECT_EQ(bvh.nearest(p, 0.99 * best).triangle, -1);
    EXPECT_EQ(bvh.nearest(p, 1.01 * best).triangle, bvh.nearest(p).triangle);
  }
}

TEST(MeshDistance, WindingNumberIsOneInsideAndZeroOutside) {
  Random random(25);
  const TriangleMesh mesh = torus(0.7, 0.25, 60, 30);
  const TriangleBvh bvh(mesh);
  const MeshDistance exact(mesh);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_point(random, 1.2);
    EXPECT_NEAR(bvh.winding_number(p), exact.distance(p) < 0 ? 1.0 : 0.0, 0.1);
  }
}

// A flat hole's fan is the missing lid itself.
TEST(MeshDistance, OfABoxWithoutALidIsThatOfTheBox) {
  Random random(26);
  const Vec3 size(0.8, 1.0, 1.4);
  TriangleMesh open = make_box(size);
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // the top
  const MeshDistance mesh(open);
  EXPECT_EQ(mesh.given_topology().open_edges, 4);
  const BoxDistance box(size);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_point(random, 1.2);
    EXPECT_NEAR(mesh.distance(p), box.distance(p), 1e-12);
  }
}

TEST(MeshDistance, OfPartsPushedIntoEachOtherHasNoOutsideWithin) {
  Random random(27);
  const Pose shift{Vec3(0.5, 0.2, 0.1), Quat::Identity()};
  const MeshDistance mesh(together(make_box({1, 1, 1}), moved(make_box({1, 1, 1}), shift)));
  EXPECT_EQ(mesh.given_topology().components, 2);
  const BoxDistance box({1, 1, 1});
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_point(random, 1.2);
    const double first = box.distance(p), second = box.distance(p - shift.position);
    EXPECT_EQ(mesh.distance(p) < 0, std::min(first, second) < 0);
    if (std::min(first, second) > 0) {
      EXPECT_NEAR(mesh.distance(p), std::min(first, second), 1e-12);
    }
    EXPECT_LE(std::abs(mesh.distance(p)), std::max(std::abs(first), std::abs(second)) + 1e-12);
  }
}

TEST(MeshDistance, TurnsMeshesThatAreInsideOutAndSeesSheets) {
  TriangleMesh mesh = make_box({1, 1, 1});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  Vec3 gradient;
  EXPECT_DOUBLE_EQ(MeshDistance(mesh).distance({0.4, 0.01, 0.02}, &gradient), -0.1);
  EXPECT_LT((gradient - Vec3::UnitX()).norm(), 1e-9);

  const MeshDistance sheet({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  EXPECT_DOUBLE_EQ(sheet.distance({0.2, 0.2, 0.3}), 0.3);
  EXPECT_DOUBLE_EQ(sheet.distance({0.2, 0.2, -0.3}), 0.3);
}

TEST(MeshDistance, HasANormalOnTheSurfaceAndNaNForNaN) {
  const MeshDistance mesh(make_box({1, 1, 1}));
  Vec3 gradient;
  EXPECT_NEAR(mesh.distance({0.5, 0.1, 0.2}, &gradient), 0.0, 1e-15);
  EXPECT_LT((gradient - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_EQ(mesh.distance({0.5, 0.5, 0.5}, &gradient), 0.0);
  EXPECT_LT((gradient - Vec3::Ones().normalized()).norm(), 1e-12);
  EXPECT_TRUE(std::isnan(mesh.distance({NAN, 0, 0}, &gradient)));
  EXPECT_THROW(MeshDistance(TriangleMesh{}), UsageError);
}

}  // namespace
}  // namespace pedicel::geometry
