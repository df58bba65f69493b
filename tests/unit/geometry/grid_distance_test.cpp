#include "engine/geometry/grid_distance.h"

#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/core/thread_pool.h"
#include "engine/geometry/primitives_mesh.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

// Rounding to single precision comes on top of the bounds: 6e-8 of the value.
constexpr double kRounding = 1e-7;

TriangleMesh open_box() {
  TriangleMesh mesh = make_box({0.06, 0.08, 0.1});
  mesh.triangles.pop_back();
  return mesh;
}

TEST(GridDistance, StaysWithinItsBoundsOfTheExactDistance) {
  Random random(31);
  const GridSettings settings{0.002, 0.01};
  const TriangleMesh overlapping = together(
      make_capsule(0.03, 0.05, 12), moved(make_box({0.04, 0.05, 0.06}), random_pose(random)));
  for (const TriangleMesh& mesh :
       {make_box({0.06, 0.08, 0.1}), torus(0.05, 0.02, 30, 15), open_box(), overlapping}) {
    const MeshDistance exact(moved(mesh, random_pose(random)));
    const GridDistance grid(exact, settings);
    const Aabb box = grid.grid_box();
    double worst_near = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 p = box.center() + random_point(random, 0.5).cwiseProduct(1.2 * box.sizes());
      const double d = exact.distance(p), error = std::abs(grid.distance(p) - d);
      if (!box.contains(p)) {
        EXPECT_LE(grid.distance(p), d + settings.far_error() + kRounding);
        EXPECT_GE(grid.distance(p), box.exteriorDistance(p));
      } else if (std::abs(d) <= settings.band) {
        EXPECT_LE(error, settings.max_error + kRounding);
        worst_near = std::max(worst_near, error);
      } else {
        EXPECT_LE(error, settings.far_error() + kRounding);
        EXPECT_EQ(grid.distance(p) < 0, d < 0);
      }
    }
    EXPECT_GT(worst_near, 0.1 * settings.max_error);  // the bound is not idle
  }
}

// Where the distance is smooth, trilinear interpolation is of second order: halving the spacing
// takes the error to a quarter.
TEST(GridDistance, IsOfSecondOrderBesideAFlatOrRoundSurface) {
  const MeshDistance exact(torus(0.05, 0.02, 160, 80));
  double error[2] = {};
  for (int level = 0; level < 2; ++level) {
    const GridDistance grid(exact, {0.004 / (1 + level), 0.005});
    Random random(32);
    for (int i = 0; i < 3000; ++i) {
      const double u = random.uniform(0, 6.28), v = random.uniform(0, 6.28);
      const double r = 0.02 + random.uniform(-0.004, 0.004), rho = 0.05 + r * std::cos(v);
      const Vec3 p(rho * std::cos(u), rho * std::sin(u), r * std::sin(v));
      error[level] += std::abs(grid.distance(p) - exact.distance(p)) / 3000;
    }
  }
  EXPECT_GT(error[0] / error[1], 3.0);
  EXPECT_LT(error[0] / error[1], 5.0);
}

// The returned direction is that of the interpolant's own gradient.
TEST(GridDistance, GradientIsUnitAndAgreesWithDifferences) {
  Random random(33);
  const GridDistance grid(MeshDistance(torus(0.05, 0.02, 60, 30)), {0.002, 0.01});
  const Aabb box = grid.grid_box();
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = box.center() + random_point(random, 0.5).cwiseProduct(1.5 * box.sizes());
    Vec3 gradient, difference;
    grid.distance(p, &gradient);
    EXPECT_NEAR(gradient.norm(), 1.0, 1e-12);
    constexpr double kStep = 1e-7;
    double kink = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = kStep * Vec3::Unit(k);
      const double ahead = grid.distance(p + step) - grid.distance(p);
      const double behind = grid.distance(p) - grid.distance(p - step);
      kink = std::max(kink, std::abs(ahead - behind) / kStep);
      difference[k] = (ahead + behind) / (2 * kStep);
    }
    if (kink > 1e-4 || difference.norm() < 0.1) continue;  // across a cell's side; a centre
    ++compared;
    EXPECT_LT((difference.normalized() - gradient).norm(), 1e-4);
  }
  EXPECT_GT(compared, 2500);
}

TEST(GridDistance, IsContinuousAcrossBlocksAndTheBorder) {
  Random random(34);
  const GridDistance grid(MeshDistance(open_box()), {0.002, 0.005});
  for (int line = 0; line < 50; ++line) {
    const Vec3 begin = random_point(random, 0.12), end = random_point(random, 0.12);
    double last = grid.distance(begin);
    constexpr int kSteps = 2000;
    for (int i = 1; i <= kSteps; ++i) {
      const double d = grid.distance(begin + double(i) / kSteps * (end - begin));
      // Slopes along the three axes are at most 1 each.
      EXPECT_LE(std::abs(d - last), 1.7321 * (end - begin).norm() / kSteps + kRounding);
      last = d;
    }
  }
}

TEST(GridDistance, HasTheSameBitsWithAnyNumberOfThreads) {
  const MeshDistance exact(open_box());
  ThreadPool pool(4);
  const GridDistance one(exact, {0.002, 0.005}), four(exact, {0.002, 0.005}, &pool);
  EXPECT_EQ(one.samples(), four.samples());
}

TEST(GridDistance, RefusesBadSettingsAndPassesNaNOn) {
  const MeshDistance exact(make_box({0.1, 0.1, 0.1}));
  EXPECT_THROW(GridDistance(exact, {0.0, 0.01}), UsageError);
  EXPECT_THROW(GridDistance(exact, {0.001, -1.0}), UsageError);
  EXPECT_THROW(GridDistance(exact, {1e-6, 0.01}), UsageError);
  const GridDistance grid(exact, {0.004, 0.01});
  Vec3 gradient;
  EXPECT_TRUE(std::isnan(grid.distance({0, NAN, 0}, &gradient)));
  EXPECT_NEAR(grid.distance({1e9, 0, 0}), 1e9, 1.0);
}

}  // namespace
}  // namespace pedicel::geometry
