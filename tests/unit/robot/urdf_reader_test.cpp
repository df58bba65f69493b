#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using testing::parse;
using testing::pi;

const char* const full_joint = R"(
<robot name="full">
  <link name="second"/>
  <link name="first"/>
  <joint name="slide" type="prismatic">
    <parent link="first"/><child link="second"/>
    <origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
    <axis xyz="0 0 2"/>
    <limit lower="-0.1" upper="0.2" effort="30" velocity="0.4"/>
    <dynamics damping="5" friction="6"/>
  </joint>
</robot>)";

TEST(UrdfReader, KeepsTheOrderOfTheFileAndEveryValueOfAJoint) {
  const RobotDescription robot = parse(full_joint);
  EXPECT_EQ(robot.name, "full");
  EXPECT_EQ(robot.file, "test.urdf");
  ASSERT_EQ(robot.links.size(), 2u);
  EXPECT_EQ(robot.links[0].name, "second");
  EXPECT_EQ(robot.root, 1);
  const Joint& joint = robot.joints.at(0);
  EXPECT_EQ(joint.type, JointType::prismatic);
  EXPECT_EQ(joint.parent, 1);
  EXPECT_EQ(joint.child, 0);
  EXPECT_EQ(joint.X_PJ.position, Vec3(1, 2, 3));
  EXPECT_NEAR((joint.X_PJ.rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 0.0, 1e-12);
  EXPECT_EQ(joint.axis, Vec3::UnitZ());
  EXPECT_EQ(joint.lower, -0.1);
  EXPECT_EQ(joint.upper, 0.2);
  EXPECT_EQ(joint.effort, 30.0);
  EXPECT_EQ(joint.velocity, 0.4);
  EXPECT_EQ(joint.damping, 5.0);
  EXPECT_EQ(joint.friction, 6.0);
}

TEST(UrdfReader, ContinuousJointsHaveNoLimitsAndTheDefaultAxisIsX) {
  const RobotDescription robot = parse(
      "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>"
      "<parent link='a'/><child link='b'/></joint></robot>");
  EXPECT_EQ(robot.joints[0].axis, Vec3::UnitX());
  EXPECT_EQ(robot.joints[0].lower, -Joint::unlimited);
  EXPECT_EQ(robot.joints[0].effort, Joint::unlimited);
}

TEST(UrdfReader, TurnsTheInertiaIntoTheLinksAxes) {
  const RobotDescription robot = parse(
      "<robot name='r'><link name='a'><inertial><origin xyz='0.1 0 0' rpy='0 0 "
      "1.5707963267948966'/>"
      "<mass value='2'/><inertia ixx='1' iyy='2' izz='2.5' ixy='0' ixz='0' iyz='0'/></inertial>"
      "</link></robot>");
  const Inertial& inertial = robot.links[0].inertial;
  EXPECT_EQ(inertial.mass, 2.0);
  EXPECT_EQ(inertial.com_L, Vec3(0.1, 0, 0));
  EXPECT_NEAR((inertial.inertia - Mat3(Vec3(2, 1, 2.5).asDiagonal())).norm(), 0.0, 1e-12);
}

TEST(UrdfReader, ReadsEveryPrimitiveAndSharedMaterials) {
  const RobotDescription robot = parse(R"(
    <robot name="r">
      <material name="red"><color rgba="1 0.5 0.25 1"/></material>
      <link name="a">
        <visual><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
        <visual><geometry><sphere radius="0.5"/></geometry></visual>
        <collision><origin xyz="0 0 4"/><geometry><cylinder radius="0.1" length="2"/></geometry></collision>
        <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      </link>
    </robot>)");
  const Link& link = robot.links[0];
  ASSERT_EQ(link.visuals.size(), 2u);
  EXPECT_EQ(link.visuals[0].geometry.size, Vec3(1, 2, 3));
  EXPECT_NEAR((link.visuals[0].color - Eigen::Vector4d(1, 0.5, 0.25, 1)).norm(), 0.0, 1e-7);
  EXPECT_EQ(link.visuals[1].geometry.kind, Geometry::Kind::sphere);
  EXPECT_EQ(link.visuals[1].geometry.radius, 0.5);
  ASSERT_EQ(link.collisions.size(), 1u);
  EXPECT_EQ(link.collisions[0].geometry.length, 2.0);
  EXPECT_EQ(link.collisions[0].X_LC.position, Vec3(0, 0, 4));
}

TEST(UrdfReader, ResolvesMimicsOfMimicsToTheJointThatMovesByItself) {
  const RobotDescription robot = parse(R"(
    <robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
      <joint name="j1" type="continuous"><parent link="a"/><child link="b"/></joint>
      <joint name="j2" type="continuous"><parent link="b"/><child link="c"/>
        <mimic joint="j1" multiplier="2" offset="0.5"/></joint>
      <joint name="j3" type="continuous"><parent link="c"/><child link="d"/>
        <mimic joint="j2" multiplier="-3" offset="1"/></joint>
    </robot>)");
  const Mimic& mimic = robot.joints[2].mimic.value();
  EXPECT_EQ(mimic.source, 0);
  EXPECT_DOUBLE_EQ(mimic.multiplier, -6.0);
  EXPECT_DOUBLE_EQ(mimic.offset, -0.5);  // -3 (2 q + 0.5) + 1
}

/// The same tetrahedron, mirrored by a negative scale, in every mesh format.
class UrdfMesh : public ::testing::TestWithParam<std::string> {};

TEST_P(UrdfMesh, LoadsTheFileWithItsScale) {
  const auto folder = pedicel::test::source_folder() / "tests/unit/robot/meshes";
  Diagnostics diagnostics;
  const auto robot = parse_urdf(
      "<robot name='r'><link name='a'><visual><geometry><mesh filename='tetrahedron" + GetParam() +
          "' scale='0.001 0.001 0.002'/></geometry></visual></link></robot>",
      folder / "test.urdf", {}, diagnostics);
  ASSERT_TRUE(robot) << diagnostics.text();
  const auto& mesh = *robot->links[0].visuals[0].geometry.mesh;
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  Vec3 high = Vec3::Zero();
  for (const Vec3& vertex : mesh.vertices) high = high.cwiseMax(vertex);
  EXPECT_NEAR((high - Vec3(0.001, 0.001, 0.002)).norm(), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Formats, UrdfMesh, ::testing::Values(".stl", ".obj", ".dae", ".gltf"));

TEST(UrdfReader, WarnsOfMaterialsThatAreDefinedNowhere) {
  Diagnostics diagnostics;
  const auto robot = parse_urdf(
      "<robot name='r'><link name='a'>"
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
      "iyz='0'/></inertial>"
      "<visual><geometry><sphere radius='1'/></geometry><material "
      "name='red'/></visual></link></robot>",
      "t.urdf", {}, diagnostics);
  ASSERT_TRUE(robot);
  EXPECT_THAT(diagnostics.text(), ::testing::HasSubstr("material 'red' is defined nowhere"));
}

TEST(UrdfReader, TakesAnEffortOfZeroAsUnlimitedAndSaysSo) {
  Diagnostics diagnostics;
  const auto robot = parse_urdf(
      "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
      "<parent link='a'/><child link='b'/><limit lower='-1' upper='1' effort='0' velocity='2'/>"
      "</joint></robot>",
      "t.urdf", {}, diagnostics);
  ASSERT_TRUE(robot);
  EXPECT_EQ(robot->joints[0].effort, Joint::unlimited);
  EXPECT_THAT(diagnostics.text(),
              ::testing::HasSubstr("effort 0 would stop the joint, taken as unlimited"));
}

}  // namespace
}  // namespace pedicel::robot
