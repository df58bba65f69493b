#include "engine/urdf/substitute_inertia.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/geometry/mass_properties.h"
#include "engine/geometry/primitives_mesh.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;
using testing::pi;

Collision box(const Vec3& size, const Vec3& at) {
  Collision collision;
  collision.X_LC.position = at;
  collision.geometry.kind = Geometry::Kind::box;
  collision.geometry.size = size;
  return collision;
}

TEST(SubstituteInertia, LeavesCompleteLinksAndMereFramesAlone) {
  Link frame;
  EXPECT_FALSE(substitute_inertia(frame, true));
  EXPECT_EQ(frame.inertial.mass, 0.0);
  Link complete;
  complete.inertial = {2.0, Vec3::Zero(), Mat3::Identity()};
  EXPECT_FALSE(substitute_inertia(complete, false));
  EXPECT_EQ(complete.inertial.inertia, Mat3::Identity());
}

// Two boxes of 1 x 2 x 3 dm side by side along x make one of 2 x 2 x 3 dm: 12 kg of water, inertia
// about x m (y^2 + z^2) / 12 and so on.
TEST(SubstituteInertia, AddsUpTheCollisionGeometryAsWater) {
  Link link;
  link.name = "arm";
  link.collisions = {box({0.1, 0.2, 0.3}, {0.05, 0, 1}), box({0.1, 0.2, 0.3}, {-0.05, 0, 1})};
  const auto sentence = substitute_inertia(link, true);
  ASSERT_TRUE(sentence);
  EXPECT_EQ(sentence->sentence(),
            "no mass; substitute: 12 kg, its collision geometry at 1000 kg/m3");
  EXPECT_NEAR(link.inertial.mass, 12.0, 1e-12);
  EXPECT_NEAR((link.inertial.com_L - Vec3(0, 0, 1)).norm(), 0.0, 1e-12);
  const Mat3 expected = Vec3(0.13, 0.13, 0.08).asDiagonal();
  EXPECT_NEAR((link.inertial.inertia - expected).norm(), 0.0, 1e-12);
}

TEST(SubstituteInertia, KeepsAStatedMassAndCentreAndSpreadsItOverTheGeometry) {
  Link link;
  link.name = "arm";
  link.inertial.mass = 3.0;
  link.inertial.com_L = Vec3(0, 0, 0.2);
  link.collisions = {box({0.2, 0.2, 0.2}, {0, 0, 0})};
  EXPECT_THAT(substitute_inertia(link, false).value().sentence(),
              HasSubstr("substitute: its collision geometry with 3 kg spread evenly"));
  EXPECT_EQ(link.inertial.com_L, Vec3(0, 0, 0.2));
  EXPECT_NEAR((link.inertial.inertia - 0.02 * Mat3::Identity()).norm(), 0.0, 1e-12);
}

TEST(SubstituteInertia, WithoutGeometryTakesASphere) {
  Link massless;
  massless.name = "arm";
  EXPECT_THAT(substitute_inertia(massless, false).value().sentence(),
              HasSubstr("a sphere of 10 mm radius at 1000 kg/m3"));
  EXPECT_NEAR(massless.inertial.mass, 4.0 / 3.0 * pi * 1e-3, 1e-12);
  Link heavy;
  heavy.inertial.mass = 4.0 / 3.0 * pi;  // radius 0.1 m
  heavy.inertial.inertia = -Mat3::Identity();
  EXPECT_THAT(substitute_inertia(heavy, false).value().sentence(), HasSubstr("a solid sphere of"));
  EXPECT_NEAR(heavy.inertial.inertia(1, 1), 0.4 * heavy.inertial.mass * 0.01, 1e-12);
}

TEST(SubstituteInertia, IsSaidOncePerLinkWithItsLine) {
  Diagnostics diagnostics;
  const auto robot = parse_urdf(
      "<robot name='r'><link name='a'/>\n<link name='b'><collision><geometry><sphere radius='0.1'/>"
      "</geometry></collision></link>\n<joint name='j' type='continuous'><parent link='a'/>"
      "<child link='b'/></joint></robot>",
      "t.urdf", {}, diagnostics);
  ASSERT_TRUE(robot);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_THAT(diagnostics.text(), HasSubstr("t.urdf:2:1: warning: link 'b': no mass"));
}

// Against the integral over a finely cut mesh of it.
TEST(SubstituteInertia, ACapsuleIsTheSolidThatItsMeshEncloses) {
  Geometry capsule;
  capsule.kind = Geometry::Kind::capsule;
  capsule.radius = 0.05;
  capsule.length = 0.3;
  Link link;
  link.collisions.push_back({{}, capsule});
  const auto solid = solid_of_geometry(link, 1000.0);
  const auto mesh = geometry::mass_properties(
      geometry::make_capsule(capsule.radius, capsule.length, 240), 1000.0);
  ASSERT_TRUE(solid && mesh);
  EXPECT_NEAR(solid->mass, mesh->mass, 1e-3 * mesh->mass);
  EXPECT_LT((solid->inertia - mesh->inertia).norm(), 1e-3 * mesh->inertia.norm());
}

}  // namespace
}  // namespace pedicel::robot
