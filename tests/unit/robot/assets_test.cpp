#include <gtest/gtest.h>

#include "engine/robot/inverse_kinematics.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

class RobotAsset : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, RobotAsset, ::testing::Values("stalk6", "gantry_gripper"));

TEST_P(RobotAsset, LoadsWithoutAWarning) {
  Diagnostics diagnostics;
  ASSERT_TRUE(read_urdf(testing::asset(GetParam()), {}, diagnostics));
  EXPECT_EQ(diagnostics.text(), "");
}

TEST_P(RobotAsset, MeshesAreSmallAndCollisionsArePrimitives) {
  for (const Link& link : load_urdf(testing::asset(GetParam())).links) {
    for (const Visual& visual : link.visuals) {
      if (!visual.geometry.mesh) continue;
      EXPECT_LT(visual.geometry.mesh->triangles.size(), 2000u);
    }
    for (const Collision& collision : link.collisions)
      EXPECT_NE(collision.geometry.kind, Geometry::Kind::mesh) << link.name;
  }
}

// The inner faces of the pads stand at +-q along the tool's y axis, level with its origin.
TEST_P(RobotAsset, ThePadsMeetAtTheTool) {
  const RobotDescription robot = load_urdf(testing::asset(GetParam()));
  const KinematicModel model(robot);
  Eigen::VectorXd q = model.neutral();
  q[model.joint_index("finger_joint")] = 0.012;
  const Pose tool = model.link_pose(q, model.link_index("tool"));
  for (const auto& [finger, side] : {std::pair{"left_finger", 1.0}, {"right_finger", -1.0}}) {
    const Link& link = robot.links[robot.link(finger)];
    const Collision& pad = link.collisions.at(0);
    EXPECT_EQ(pad.geometry.size, Vec3(0.020, 0.004, 0.030));
    const Pose X_TP = tool.inverse() * model.link_pose(q, robot.link(finger)) * pad.X_LC;
    EXPECT_NEAR((X_TP.position - Vec3(0, side * 0.014, 0)).norm(), 0.0, 1e-9);
  }
}

TEST_P(RobotAsset, ReachesForwardAndDown) {
  const KinematicModel model(load_urdf(testing::asset(GetParam())));
  for (const Vec3& approach : {Vec3(1, 0, 0), Vec3(0, 0, -1)}) {
    const IkTarget target{model.link_index("tool"), Vec3(0.28, 0.05, 0.2), {}, approach};
    EXPECT_TRUE(inverse_kinematics(model, target, model.neutral()).reached);
  }
}

// The facts that stalk6 takes from the maker's file.
TEST(Stalk6, HasTheLite6sKinematicsAndMasses) {
  if (!std::filesystem::exists(testing::lite6_path())) GTEST_SKIP() << "no lite6 data";
  const RobotDescription own = load_urdf(testing::asset("stalk6"));
  const RobotDescription maker = load_urdf(testing::lite6_path());
  const KinematicModel own_model(own), maker_model(maker);
  for (int i = 1; i <= 6; ++i) {
    const std::string name = "joint" + std::to_string(i);
    const Joint& a = own.joints[own.joint(name)];
    const Joint& b = maker.joints[maker.joint(name)];
    EXPECT_NEAR(a.lower, b.lower, 1e-8);
    EXPECT_NEAR(a.upper, b.upper, 1e-8);
    EXPECT_EQ(a.effort, b.effort);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.damping, b.damping);
    EXPECT_EQ(a.friction, b.friction);
    const Inertial &m = own.links[a.child].inertial, &n = maker.links[b.child].inertial;
    EXPECT_EQ(m.mass, n.mass);
    EXPECT_EQ(m.com_L, n.com_L);
    EXPECT_NEAR((m.inertia - n.inertia).norm(), 0.0, 1e-9);
  }
  Random random(51);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd q = testing::random_positions(own_model, random);
    const Pose a = own_model.link_pose(q, own.link("flange"));
    const Pose b = maker_model.link_pose(q.head<6>(), maker.link("link6"));
    EXPECT_NEAR((a.position - b.position).norm(), 0.0, 2e-5);  // the maker rounds its angles
    EXPECT_LT(a.rotation.angularDistance(b.rotation), 5e-5);
  }
}

}  // namespace
}  // namespace pedicel::robot
