#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "unit/robot/robot_cases.h"

// What people's URDFs hold and the standard does not foresee: read where it has one meaning, with a
// warning where something was left out.
namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

struct Read {
  std::optional<RobotDescription> robot;
  std::string text;
  std::size_t lines = 0;
};

Read read(const std::string& urdf, const std::string& file = "t.urdf") {
  Diagnostics diagnostics;
  Read result;
  result.robot = parse_urdf(urdf, file, {}, diagnostics);
  result.text = diagnostics.text();
  result.lines = diagnostics.all().size();
  return result;
}

std::string robot(const std::string& inside) {
  return "<robot name='r'>" + inside + "</robot>";
}

const std::string mass = testing::inertial(1.0, "0 0 0", "1", "1", "1");

/// Two links of 1 kg and a joint with `inside` in it.
std::string jointed(const std::string& type, const std::string& inside) {
  return robot("<link name='a'>" + mass + "</link><link name='b'>" + mass +
               "</link>\n<joint name='j' type='" + type + "'><parent link='a'/><child link='b'/>" +
               inside + "</joint>");
}

std::string shaped(const std::string& shapes) {
  return robot("<link name='a'>" + mass + shapes + "</link>");
}

std::string collision(const std::string& shape) {
  return "<collision><geometry>" + shape + "</geometry></collision>\n";
}

TEST(UrdfAsItIs, NothingOfAFixedJointButItsPlaceIsLookedAt) {
  for (const std::string inside :
       {"<axis xyz='0 0 0'/>", "<axis/>", "<axis xzy='1 0 0'/>", "<axis xyz='a b'/>",
        "<limit lower='1' upper='0' effort='x'/>", "<dynamics/>", "<mimic joint='nowhere'/>",
        "<safety_controller/>", "<calibration/>"}) {
    const Read found = read(jointed("fixed", inside));
    ASSERT_TRUE(found.robot) << inside << found.text;
    EXPECT_EQ(found.text, "") << inside;
  }
  EXPECT_FALSE(read(jointed("continuous", "<axis xyz='0 0 0'/>")).robot);
  EXPECT_FALSE(read(jointed("fixed", "<origin xyz='0 0'/>")).robot);
}

TEST(UrdfAsItIs, MinusOneIsNoLimit) {
  const Read found =
      read(jointed("revolute", "<limit lower='0' upper='1' effort='-1' velocity='-1'/>"));
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.robot->joints[0].effort, Joint::unlimited);
  EXPECT_EQ(found.robot->joints[0].velocity, Joint::unlimited);
  EXPECT_THAT(found.text, HasSubstr("t.urdf:2:95: warning: joint 'j': effort -1, taken as "
                                    "unlimited"));
}

TEST(UrdfAsItIs, AnEffortThatIsNotThereIsNoLimit) {
  const Read found = read(jointed("revolute", "<limit lower='0' upper='1' velocity='2'/>"));
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.robot->joints[0].effort, Joint::unlimited);
  EXPECT_EQ(found.robot->joints[0].velocity, 2.0);
  EXPECT_THAT(found.text, HasSubstr("joint 'j': no effort, taken as unlimited"));
}

TEST(UrdfAsItIs, CrossedLimitsAreNone) {
  const Read found =
      read(jointed("revolute", "<limit lower='1' upper='-1' effort='1' velocity='1'/>"));
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.robot->joints[0].lower, -Joint::unlimited);
  EXPECT_EQ(found.robot->joints[0].upper, Joint::unlimited);
  EXPECT_THAT(found.text, HasSubstr("joint 'j': limit with lower above upper, taken as unlimited"));
}

TEST(UrdfAsItIs, ARobotWithoutANameHasThatOfItsFile) {
  const Read found = read("<robot><link name='a'/></robot>", "arms/ur3.urdf");
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.robot->name, "ur3");
  EXPECT_THAT(found.text, HasSubstr("robot: no name, the file's is taken: 'ur3'"));
}

TEST(UrdfAsItIs, ShapesWithoutExtentAreLeftOutAndSaidOnce) {
  const std::string nothing =
      collision("<box size='0 0 0'/>") + collision("<sphere radius='0.0'/>") +
      collision("<cylinder radius='0' length='1'/>") +
      collision("<cylinder radius='1' length='0'/>") +
      collision("<capsule radius='0' length='1'/>") + collision("<box size='1 1 0'/>");
  const Read found = read(shaped(nothing + collision("<sphere radius='1'/>")));
  ASSERT_TRUE(found.robot) << found.text;
  ASSERT_EQ(found.robot->links[0].collisions.size(), 1u);
  EXPECT_EQ(found.robot->links[0].collisions[0].geometry.radius, 1.0);
  EXPECT_EQ(found.lines, 1u) << found.text;
  EXPECT_THAT(found.text, HasSubstr("link 'a': collision of size 0, left out (6 times)"));
}

TEST(UrdfAsItIs, TheSameRemarkOnManyLinksNamesTheFirst) {
  std::string links, joints;
  for (int i = 0; i < 12; ++i) {
    const std::string name = "l" + std::to_string(i);
    links += "<link name='" + name + "'>" + mass + collision("<box size='0 0 0'/>") + "</link>";
    if (i > 0)
      joints += "<joint name='j" + name + "' type='fixed'><parent link='l0'/><child link='" + name +
                "'/></joint>";
  }
  const Read found = read(robot(links + joints));
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.lines, 1u);
  EXPECT_THAT(found.text, HasSubstr("link 'l0', link 'l1', link 'l2' and 9 more: collision of "
                                    "size 0, left out (12 times)"));
}

TEST(UrdfAsItIs, CapsulesAreReadFromTheXml) {
  const Read found = read(shaped(collision("<capsule radius='0.1' length='0.4'/>") +
                                 "<visual><geometry><capsule radius='0.2' length='0.6'/></geometry>"
                                 "</visual>"));
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.text, "");
  const Geometry& touched = found.robot->links[0].collisions.at(0).geometry;
  EXPECT_EQ(touched.kind, Geometry::Kind::capsule);
  EXPECT_EQ(touched.radius, 0.1);
  EXPECT_EQ(touched.length, 0.4);
  EXPECT_EQ(found.robot->links[0].visuals.at(0).geometry.kind, Geometry::Kind::capsule);
}

TEST(UrdfAsItIs, QuaternionsAreReadWhereverAnOriginMayBe) {
  // A quarter turn about z, then about x: not one that rpy's order would leave alone.
  const Quat q = Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ())) *
                 Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  std::ostringstream origin;
  origin.precision(17);
  origin << "<origin xyz='1 2 3' quat_xyzw='" << q.x() << " " << q.y() << " " << q.z() << " "
         << q.w() << "'/>";
  const std::string link =
      "<link name='b'><inertial>" + origin.str() +
      "<mass value='1'/><inertia ixx='1' iyy='1.5' izz='2' ixy='0' ixz='0' iyz='0'/></inertial>"
      "<visual>" +
      origin.str() + "<geometry><sphere radius='1'/></geometry></visual><collision>" +
      origin.str() + "<geometry><sphere radius='1'/></geometry></collision></link>";
  const Read found =
      read("<robot name='r' version='1.1'><link name='a'>" + mass + "</link>" + link +
           "<joint name='j' type='fixed'><parent link='a'/><child link='b'/>" + origin.str() +
           "</joint></robot>");
  ASSERT_TRUE(found.robot) << found.text;
  const Link& b = found.robot->links[1];
  const Vec3 xyz(1, 2, 3);
  EXPECT_EQ(b.inertial.com_L, xyz);
  const Mat3 turned =
      q.toRotationMatrix() * Vec3(1, 1.5, 2).asDiagonal() * q.toRotationMatrix().transpose();
  EXPECT_LT((b.inertial.inertia - turned).norm(), 1e-12);
  for (const Pose& pose :
       {b.visuals.at(0).X_LV, b.collisions.at(0).X_LC, found.robot->joints[0].X_PJ}) {
    EXPECT_EQ(pose.position, xyz);
    EXPECT_LT(pose.rotation.angularDistance(q), 1e-12);
  }
}

TEST(UrdfAsItIs, EntitiesOfADoctypeAreReadAndLinesKeepTheirNumbers) {
  const std::string head =
      "<?xml version='1.0'?>\n<!DOCTYPE robot [\n <!ENTITY half '0.5'>\n <!ENTITY both \"&half; "
      "&half;\">\n]>\n";
  const Read found = read(head + shaped(collision("<box size='&both; &half;'/>")));
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.robot->links[0].collisions.at(0).geometry.size, Vec3::Constant(0.5));
  const Read bad = read(head + shaped(collision("<box size='-1 &both;'/>")));
  EXPECT_THAT(bad.text, HasSubstr("t.urdf:6:"));
  EXPECT_TRUE(read("<!DOCTYPE robot>" + shaped("")).robot);
  EXPECT_TRUE(read("<!DOCTYPE robot SYSTEM 'robot.dtd'>" + shaped("")).robot);
}

TEST(UrdfAsItIs, ARobotWithoutMovingJointsStands) {
  const std::string standing =
      robot("<link name='a'>" + mass + collision("<sphere radius='0.1'/>") +
            "</link><link name='b'>" + mass +
            "</link><joint name='j' type='fixed'><parent link='a'/>"
            "<child link='b'/><origin xyz='0 0 1'/></joint>");
  for (const std::string& text : {standing, robot("<link name='alone'/>")}) {
    testing::World world;
    Robot robot(testing::parse(text), {}, world.world);
    for (int i = 0; i < 10; ++i) {
      world.step(robot, 1.0 / 240.0);
      robot.push_back(std::vector<LinkPush>{{0, Vec3(1, 2, 3), Vec3::Zero(), Vec3::Zero()}},
                      1.0 / 240.0);
    }
    EXPECT_EQ(robot.model().dofs(), 0);
    EXPECT_EQ(robot.link_poses().front().position, Vec3::Zero());
    EXPECT_EQ(robot.link_poses().back().position.z(), text == standing ? 1.0 : 0.0);
    EXPECT_EQ(robot.mobility(0, Vec3::Zero(), 0, Vec3::Zero()), 0.0);
  }
}

TEST(UrdfAsItIs, AByteOrderMarkIsNoFault) {
  EXPECT_TRUE(read("\xef\xbb\xbf" + shaped("")).robot);
}

TEST(UrdfAsItIs, ColoursThatAreNoneAreGrey) {
  const auto visual = [](const std::string& material) {
    return shaped("<visual><geometry><sphere radius='1'/></geometry>" + material + "</visual>");
  };
  for (const std::string colour :
       {"<color rgba='255 0 0 1'/>", "<color rgba='1 1'/>", "<color/>"}) {
    const Read found = read(visual("<material name='m'>" + colour + "</material>"));
    ASSERT_TRUE(found.robot) << found.text;
    EXPECT_EQ(found.robot->links[0].visuals.at(0).color, Eigen::Vector4d(0.7, 0.7, 0.7, 1.0));
    EXPECT_THAT(found.text, HasSubstr("expected four numbers in 0..1; drawn grey"));
  }
  const Read opaque = read(visual("<material><color rgba='1 0.5 0'/></material>"));
  ASSERT_TRUE(opaque.robot) << opaque.text;
  EXPECT_EQ(opaque.robot->links[0].visuals.at(0).color, Eigen::Vector4d(1, 0.5, 0, 1));
}

TEST(UrdfAsItIs, MaterialsMayBeDefinedTwice) {
  const Read found = read(
      "<robot name='r'><material name='m'><color rgba='1 0 0 1'/></material><material name='m'>"
      "<color rgba='0 1 0 1'/></material><link name='a'><visual><geometry><sphere radius='1'/>"
      "</geometry><material name='m'/></visual></link></robot>");
  ASSERT_TRUE(found.robot) << found.text;
  EXPECT_EQ(found.robot->links[0].visuals.at(0).color, Eigen::Vector4d(1, 0, 0, 1));
}

}  // namespace
}  // namespace pedicel::robot
