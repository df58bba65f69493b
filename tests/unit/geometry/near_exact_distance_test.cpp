#include "engine/geometry/near_exact_distance.h"

#include <gtest/gtest.h>

#include "engine/geometry/primitives_mesh.h"
#include "engine/geometry/shapes.h"
#include "tests/unit/geometry/support.h"

// A box of 2 m: its exact distance is known in closed form.
namespace pedicel::geometry {
namespace {

const Vec3 size(2.0, 1.0, 0.5);
constexpr double band = 0.01;

NearExactDistance field() {
  const GridSettings settings = coarse_settings(size, 0x1p16);
  const MeshDistance exact(make_box(size));
  return {exact, GridDistance(exact, settings), settings, band};
}

TEST(NearExactDistance, IsExactWithinItsBandAndNeverTooLargeOutside) {
  const NearExactDistance tried = field();
  const BoxDistance truth(size);
  Random random(7);
  int near = 0, far = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = random_point(random, 1.5);
    const double d = truth.distance(p), found = tried.distance(p);
    if (std::abs(d) <= band) {
      EXPECT_NEAR(found, d, 1e-9);
      ++near;
    } else if (d > 0.0) {
      EXPECT_LE(found, d + 1e-6);
      const bool in_grid = d < coarse_settings(size, 0x1p16).band;
      EXPECT_GE(found, in_grid ? d - tried.error() : 0.0);
      ++far;
    }
  }
  EXPECT_GT(near, 50);
  EXPECT_GT(far, 5000);
}

TEST(NearExactDistance, APointThatIsNotFiniteHasNoDistance) {
  EXPECT_TRUE(std::isnan(field().distance(Vec3(0, std::nan(""), 0))));
}

TEST(CoarseSettings, KeepTheBoundWhateverTheSize) {
  for (const Vec3& one : {Vec3(1, 1, 1), Vec3(5, 4, 0.8), Vec3(350, 2, 2), Vec3(1e5, 1e5, 1e5)}) {
    const GridSettings settings = coarse_settings(one, 0x1p20);
    EXPECT_LE(GridDistance::sample_count(one, settings), 0x1p20);
  }
  EXPECT_EQ(coarse_settings(Vec3(0.1, 0.1, 0.1), 0x1p20).max_error, GridSettings().max_error);
}

}  // namespace
}  // namespace pedicel::geometry
