#include "engine/render/draw_list.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace pedicel::render {
namespace {

std::vector<TubePoint> random_chain(Random& random, int count) {
  std::vector<TubePoint> points;
  Vec3 position = Vec3::Zero();
  for (int i = 0; i < count; ++i) {
    points.push_back({position, random.uniform(0.001, 0.01), {}});
    position += Vec3(random.normal(), random.normal(), random.normal()) * 0.05;
  }
  return points;
}

// What makes a chain of stretches one smooth tube: neighbours share point, radius, tangent and
// side.
TEST(DrawList, TubeStretchesShareTheirEnds) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    DrawList list;
    list.add_tube(random_chain(random, 12));
    ASSERT_EQ(list.tubes.size(), 11u);
    for (std::size_t i = 0; i < list.tubes.size(); ++i) {
      const TubeSegment& t = list.tubes[i];
      EXPECT_NEAR(t.side0.norm(), 1.0, 1e-9);
      EXPECT_EQ(t.rounded, i == 0 || i == 10) << "only the ends are closed";
      EXPECT_NEAR(t.side1.dot(t.tangent1), 0.0, 1e-9);
      if (i == 0) continue;
      const TubeSegment& before = list.tubes[i - 1];
      EXPECT_EQ(before.p1, t.p0);
      EXPECT_EQ(before.r1, t.r0);
      EXPECT_EQ(before.tangent1, t.tangent0);
      EXPECT_EQ(before.side1, t.side0);
    }
  }
}

TEST(DrawList, DegenerateTubes) {
  DrawList list;
  list.add_tube({});
  EXPECT_TRUE(list.bounds().isEmpty());
  const TubePoint point{Vec3(1, 2, 3), 0.1, {}};
  list.add_tube(std::vector<TubePoint>{point, point});
  EXPECT_EQ(list.tubes.size(), 0u);
  EXPECT_EQ(list.spheres.size(), 1u);
  // A chain that folds back on itself still has finite tangents.
  list.add_tube(std::vector<TubePoint>{
      {Vec3::Zero(), 0.1, {}}, {Vec3::UnitX(), 0.1, {}}, {Vec3::Zero(), 0.1, {}}});
  for (const TubeSegment& t : list.tubes) {
    EXPECT_NEAR(t.tangent1.norm(), 1.0, 1e-9);
    EXPECT_NEAR(t.side1.norm(), 1.0, 1e-9);
  }
}

TEST(DrawList, BoundsEncloseEveryKind) {
  DrawList list;
  list.capsules.push_back({Vec3(0, 0, 0), Vec3(1, 0, 0), 0.1, 0.2, {}});
  EXPECT_EQ(list.bounds().max(), Vec3(1.2, 0.2, 0.2));
  list.spheres.push_back({Vec3(0, 0, -3), 0.5, {}});
  EXPECT_EQ(list.bounds().min().z(), -3.5);
  const Quat quarter(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitZ()));
  list.boxes.push_back({{Vec3::Zero(), quarter}, Vec3(1, 4, 1), {}});
  EXPECT_NEAR(list.bounds().min().x(), -4.0, 1e-9);
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {0, 9, 0}, {0, 0, 1}};
  mesh->triangles = {{0, 1, 2}};
  list.meshes.push_back({mesh, {}, {}});
  EXPECT_EQ(list.bounds().max().y(), 9.0);
  list.blades.push_back({Vec3(0, 0, 7), Vec3(0, 0, 0), Vec3(0, 1, 0), {}});
  EXPECT_EQ(list.bounds().max().z(), 7.0);
  list.lines.push_back({Vec3(20, 0, 0), Vec3(0, 0, 0), {}});
  EXPECT_EQ(list.bounds().max().x(), 20.0);
  list.clear();
  EXPECT_TRUE(list.bounds().isEmpty());
  EXPECT_TRUE(list.ground.has_value());
}

TEST(DrawList, ArrowEndsAtItsTip) {
  DrawList list;
  list.add_arrow(Vec3::Zero(), Vec3(0, 0, 1), 0.01, {});
  ASSERT_EQ(list.capsules.size(), 2u);
  EXPECT_EQ(list.capsules[1].p1, Vec3(0, 0, 1));
  list.clear();
  list.add_arrow(Vec3::Zero(), Vec3(0, 0, 1e-9), 0.01, {});
  EXPECT_TRUE(list.capsules.empty());
}

TEST(Colour, Hex) {
  constexpr Colour c = Colour::hex(0xff8000);
  EXPECT_EQ(c.r, 1.0f);
  EXPECT_NEAR(c.g, 128.0f / 255.0f, 1e-6);
  EXPECT_EQ(c.b, 0.0f);
}

}  // namespace
}  // namespace pedicel::render
