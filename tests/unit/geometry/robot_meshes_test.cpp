// The visual meshes of robots: several parts or walls inside, and with makers many that are not
// watertight. They must load, give a usable distance, and mass properties.
#include <gtest/gtest.h>

#include "engine/geometry/grid_distance.h"
#include "engine/geometry/mass_properties.h"
#include "tests/support/places.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

/// The meshes of our own arm and, where they lie beside the tree, of the one by a maker.
std::vector<std::filesystem::path> meshes() {
  std::vector<std::filesystem::path> found;
  for (const char* part :
       {"base", "shoulder", "upper_arm", "elbow", "forearm", "wrist", "flange", "gripper"})
    found.push_back(pedicel::test::source_folder() / "assets/robots/stalk6/meshes" /
                    (std::string(part) + "_grey.obj"));
  const auto makers =
      pedicel::test::shared_folder() / "data/lite6/xarm_description/meshes/lite6/visual";
  for (const char* part : {"base.stl", "link1.stl", "link2.stl", "link3.stl", "link4.stl",
                           "link5.stl", "link6.stl", "gripper_lite.stl"})
    if (std::filesystem::exists(makers / part)) found.push_back(makers / part);
  return found;
}

class RobotMesh : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(RobotMesh, GivesAContinuousDistanceAndAMass) {
  const TriangleMesh mesh = load_mesh(GetParam());
  EXPECT_GT(mesh.triangles.size(), 100u);
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

INSTANTIATE_TEST_SUITE_P(All, RobotMesh, testing::ValuesIn(meshes()),
                         [](const auto& mesh) { return mesh.param.stem().string(); });

}  // namespace
}  // namespace pedicel::geometry
