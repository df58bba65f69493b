// Closed meshes of known solids: their topology, volume and inertia.
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/geometry/aabb.h"
#include "engine/geometry/mass_properties.h"
#include "engine/geometry/mesh_topology.h"
#include "engine/geometry/primitives_mesh.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(PrimitiveMesh, IsClosedOutwardAndOfTheRightSize) {
  struct Case {
    TriangleMesh mesh;
    Vec3 half;
    double volume;
  };
  const Case cases[] = {{make_box({1, 2, 3}), {0.5, 1, 1.5}, 6.0},
                        {make_cylinder(0.5, 2, 200), {0.5, 0.5, 1}, kPi * 0.5},
                        {make_sphere(0.5, 200), {0.5, 0.5, 0.5}, kPi / 6},
                        {make_capsule(0.5, 2, 200), {0.5, 0.5, 1.5}, kPi * (0.5 + 1.0 / 6)},
                        {make_sphere(0.5, 3), {0.5, 0.5, 0.5}, 0.0},
                        {make_capsule(0.5, 1, 3), {0.5, 0.5, 1}, 0.0}};
  for (const Case& c : cases) {
    EXPECT_TRUE(topology(c.mesh).manifold());
    EXPECT_LT((bounds(c.mesh).max() - c.half).maxCoeff(), 1e-12);
    double volume = 0.0;
    for (const auto& t : c.mesh.triangles)
      volume += c.mesh.vertices[t[0]].dot(c.mesh.vertices[t[1]].cross(c.mesh.vertices[t[2]])) / 6;
    EXPECT_GT(volume, 0.0);
    if (c.volume > 0.0) {
      EXPECT_NEAR(volume, c.volume, 1e-3 * c.volume);
      EXPECT_LT((bounds(c.mesh).max() - c.half).norm(), 1e-12);
    }
  }
}

TEST(PrimitiveMesh, RefusesSizesThatAreNotPositive) {
  EXPECT_THROW(make_box({1, 0, 1}), UsageError);
  EXPECT_THROW(make_cylinder(-1, 1), UsageError);
  EXPECT_THROW(make_capsule(1, NAN), UsageError);
  EXPECT_THROW(make_sphere(1, 2), UsageError);
}

TEST(MeshTopology, TellsOpenEdgesPartsAndFolds) {
  TriangleMesh box = make_box({1, 1, 1});
  const MeshTopology two = topology(together(box, moved(box, {Vec3(3, 0, 0), Quat::Identity()})));
  EXPECT_TRUE(two.closed());
  EXPECT_EQ(two.components, 2);
  EXPECT_FALSE(two.manifold());

  TriangleMesh flipped = box;
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  EXPECT_EQ(topology(flipped).open_edges, 3);

  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_EQ(topology(open).open_edges, 3);
  EXPECT_EQ(topology(open).components, 1);

  TriangleMesh folded = box;  // an inner wall, seen from both sides
  folded.triangles.push_back({0, 1, 7});
  folded.triangles.push_back({0, 7, 1});
  EXPECT_TRUE(topology(folded).closed());
  EXPECT_EQ(topology(folded).non_manifold_edges, 2);  // 0-1 and 1-7; 0-7 was no edge before
}

TEST(MeshTopology, HolesAreClosedWithoutTouchingTheRest) {
  TriangleMesh open = make_cylinder(0.5, 2, 16);
  std::erase_if(open.triangles, [&](const auto& t) {  // both lids
    return std::max({t[0], t[1], t[2]}) >= 32;
  });
  open.vertices.resize(32);
  const TriangleMesh closed = close_holes(open);
  EXPECT_EQ(topology(open).open_edges, 32);
  EXPECT_TRUE(topology(closed).manifold());
  EXPECT_EQ(closed.triangles.size(), make_cylinder(0.5, 2, 16).triangles.size());
  EXPECT_TRUE(std::equal(open.triangles.begin(), open.triangles.end(), closed.triangles.begin()));
  EXPECT_LT((closed.vertices[32] - Vec3(0, 0, -1)).norm(), 1e-12);
  EXPECT_EQ(close_holes(closed).triangles.size(), closed.triangles.size());
}

// Box: m/12 (b^2 + c^2) on the x axis; solid sphere: 2/5 m r^2; cylinder: m (3 r^2 + l^2)/12
// across.
TEST(MassProperties, MatchTheFormulas) {
  const auto box = mass_properties(make_box({1, 2, 3}), 500.0);
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->volume, 6.0, 1e-12);
  EXPECT_NEAR(box->mass, 3000.0, 1e-9);
  EXPECT_LT(box->centre.norm(), 1e-12);
  const Mat3 expected = Vec3(4 + 9, 1 + 9, 1 + 4).asDiagonal();
  EXPECT_LT((box->inertia - 3000.0 / 12.0 * expected).norm(), 1e-9);

  const auto sphere = mass_properties(make_sphere(0.1, 200), 1000.0);
  ASSERT_TRUE(sphere);
  EXPECT_NEAR(sphere->inertia(0, 0), 0.4 * sphere->mass * 0.01, 1e-3 * sphere->inertia(0, 0));
  const auto rod = mass_properties(make_cylinder(0.1, 1, 200), 1000.0);
  ASSERT_TRUE(rod);
  EXPECT_NEAR(rod->inertia(0, 0), rod->mass * (0.03 + 1.0) / 12, 1e-3 * rod->inertia(0, 0));
}

TEST(MassProperties, TurnWithTheBody) {
  Random random(7);
  const TriangleMesh body =
      together(make_box({1, 2, 3}), moved(make_sphere(0.5, 12), {Vec3(2, 1, 0), Quat::Identity()}));
  const auto still = mass_properties(body, 800.0);
  ASSERT_TRUE(still);
  for (int i = 0; i < 20; ++i) {
    const Pose pose = random_pose(random);
    const auto turned = mass_properties(moved(body, pose), 800.0);
    ASSERT_TRUE(turned);
    const Mat3 rotation = pose.rotation.toRotationMatrix();
    EXPECT_NEAR(turned->mass, still->mass, 1e-9 * still->mass);
    EXPECT_LT((turned->centre - pose * still->centre).norm(), 1e-10);
    EXPECT_LT((turned->inertia - rotation * still->inertia * rotation.transpose()).norm(),
              1e-9 * still->inertia.norm());
  }
}

TEST(MassProperties, SurviveHolesInsideOutAndFlatMeshes) {
  TriangleMesh mesh = make_box({1, 1, 1});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);  // no floor
  const auto box = mass_properties(mesh, 1.0);
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->volume, 1.0, 1e-12);
  EXPECT_NEAR(box->inertia(0, 0), 1.0 / 6.0, 1e-12);

  const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_FALSE(mass_properties(sheet, 1.0));
  EXPECT_THROW(mass_properties(mesh, 0.0), UsageError);
}

}  // namespace
}  // namespace pedicel::geometry
