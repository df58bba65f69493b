// The visual meshes of a real robot: most are not watertight, some have several parts or walls
// inside. They must load, give a usable distance, and mass properties.
#include <gtest/gtest.h>

#include "pedicel/geometry/grid_distance.h"
#include "pedicel/geometry/mass_properties.h"
#include "places.h"
#include "support.h"

namespace pedicel::geometry {
namespace {

std::filesystem::path folder() {
  return std::filesystem::path(PEDICEL_SHARED_DIR) /
         "data/lite6/xarm_description/meshes/lite6/visual";
}

class Lite6 : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder())) GTEST_SKIP() << "no practice data: " << folder();
  }
};

TEST_P(Lite6, MeshGivesAContinuousDistanceAndAMass) {
  const TriangleMesh mesh = load_mesh(folder() / GetParam());
  EXPECT_GT(mesh.triangles.size(), 3000u);
  const Aabb box = bounds(mesh);
  EXPECT_LT(box.sizes().maxCoeff(), 0.3);
  const auto mass = mass_properties(mesh, 1000.0);
  ASSERT_TRUE(mass);
  EXPECT_GT(mass->volume, 0.05 * box.volume());
  EXPECT_LT(mass->volume, box.volume());
  EXPECT_TRUE(box.contains(mass->centre));

  const MeshDistance exact(mesh);
  const GridSettings settings{0.003, 0.006};
  const GridDistance grid(exact, settings);
  Random random(51);
  int inside = 0;
  constexpr int kPoints = 3000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p = box.center() + random_point(random, 0.55).cwiseProduct(box.sizes());
    const Vec3 q = p + 0.002 * random_unit(random);
    Vec3 gradient;
    const double d = exact.distance(p, &gradient);
    EXPECT_LE(std::abs(d - exact.distance(q)), 0.002 + 1e-9);  // 1-Lipschitz: no torn signs
    EXPECT_NEAR(gradient.norm(), 1.0, 1e-9);
    EXPECT_LE(std::abs(grid.distance(p) - d),
              (std::abs(d) <= settings.band ? settings.max_error : settings.far_error()) + 1e-7);
    inside += d < 0;
  }
  EXPECT_GT(inside, kPoints / 50);
  // The sign away from the body is plain.
  EXPECT_GT(exact.distance(box.max() + Vec3::Constant(0.01)), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Links, Lite6,
                         testing::Values("base.stl", "link1.stl", "link2.stl", "link3.stl",
                                         "link4.stl", "link5.stl", "link6.stl", "gripper_lite.stl"),
                         [](const auto& link) {
                           const std::string name = link.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace pedicel::geometry
