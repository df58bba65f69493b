#include "plugins/plant/point_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/core/check.h"
#include "engine/core/random.h"

namespace pedicel::plant {
namespace {

/// What the grid stands for: a loop over all points.
PointGrid::Nearest plain_nearest(const PointGrid& grid, const Vec3& place, double reach) {
  PointGrid::Nearest best{-1, reach};
  for (int i = 0; i < grid.size(); ++i) {
    const double distance = (grid[i] - place).norm();
    if (distance < best.distance) best = {i, distance};
  }
  return best;
}

/// Scattered, on a lattice (many ties), in heaps, along a line, and far from the origin.
Vec3 generated(Random& random, int kind) {
  const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  if (kind == 1) return (4.0 * p).array().round() / 4.0;
  if (kind == 2) return (2.0 * p).array().round().matrix() + 1e-3 * p;
  if (kind == 3) return {p.x(), 0.0, 0.0};
  if (kind == 4) return p + Vec3(1e7, -1e7, 1e7);
  return p;
}

TEST(PointGrid, FindsWhatALoopOverAllPointsFinds) {
  Random random(5);
  int found = 0, missed = 0;
  for (int kind = 0; kind < 5; ++kind)
    for (const double reach : {1e-4, 0.01, 0.25, 0.5, 3.0}) {
      PointGrid grid(reach);
      for (int i = 0; i < 400; ++i) grid.add(generated(random, kind));
      for (int i = 0; i < 200; ++i) {
        const Vec3 place = i % 4 ? generated(random, kind) : grid[i];
        const PointGrid::Nearest plain = plain_nearest(grid, place, reach);
        const PointGrid::Nearest nearest = grid.nearest(place);
        ASSERT_EQ(nearest.point, plain.point) << "kind " << kind << ", reach " << reach;
        ASSERT_EQ(nearest.distance, plain.distance);
        ++(plain.point < 0 ? missed : found);
      }
    }
  EXPECT_GT(found, 1000);
  EXPECT_GT(missed, 300);
}

TEST(PointGrid, VisitsEveryPointWithinReach) {
  Random random(6);
  PointGrid grid(0.3);
  for (int i = 0; i < 500; ++i) grid.add(generated(random, 0));
  for (int i = 0; i < 100; ++i) {
    const Vec3 place = generated(random, 0);
    std::set<int> visited;
    grid.for_each_near(place, [&](int point) { EXPECT_TRUE(visited.insert(point).second); });
    for (int p = 0; p < grid.size(); ++p) {
      const bool near = (grid[p] - place).norm() < 0.3;
      EXPECT_TRUE(!near || visited.contains(p));
    }
  }
}

TEST(PointGrid, RefusesAReachThatIsNone) {
  EXPECT_THROW(PointGrid(0.0), UsageError);
  EXPECT_THROW(PointGrid(std::nan("")), UsageError);
}

}  // namespace
}  // namespace pedicel::plant
