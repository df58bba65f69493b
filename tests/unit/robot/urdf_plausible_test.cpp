#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"
#include "tests/unit/robot/robot_cases.h"

// What no real robot has is warned of, and changes nothing.
namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

std::string warned(const std::string& inside, const std::string& file = "t.urdf") {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_urdf("<robot name='r'>" + inside + "</robot>", file, {}, diagnostics))
      << diagnostics.text();
  return diagnostics.text();
}

std::string link(const std::string& inertial, const std::string& shape = "<sphere radius='0.1'/>") {
  return "<link name='a'>" + inertial + "<collision><geometry>" + shape +
         "</geometry></collision></link>";
}

std::string jointed(const std::string& type, const std::string& inside) {
  return link(testing::inertial(1, "0 0 0", "0.01", "0.01", "0.01")) + "<link name='b'>" +
         testing::inertial(1, "0 0 0", "0.01", "0.01", "0.01") + "</link><joint name='j' type='" +
         type + "'><parent link='a'/><child link='b'/>" + inside + "</joint>";
}

std::string limited(double low, double high) {
  return "<limit lower='" + std::to_string(low) + "' upper='" + std::to_string(high) +
         "' effort='1' velocity='1'/>";
}

/// A tetrahedron with edges of that length along the axes.
void write_mesh(const std::filesystem::path& path, double length) {
  std::ofstream(path) << "v 0 0 0\nv " << length << " 0 0\nv 0 " << length << " 0\nv 0 0 " << length
                      << "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

TEST(UrdfPlausible, ARobotOfCommonSizesIsNotRemarkedOn) {
  EXPECT_EQ(warned(link(testing::inertial(1, "0 0 0", "0.01", "0.01", "0.01"))), "");
  EXPECT_EQ(warned(jointed("revolute",
                           "<origin xyz='0 0 0.5' rpy='3.14 0 -3.14'/>" + limited(-3.14, 3.14))),
            "");
}

TEST(UrdfPlausible, MassesAndInertias) {
  EXPECT_THAT(warned(link(testing::inertial(1e6, "0 0 0", "1e4", "1e4", "1e4"))),
              HasSubstr("warning: link 'a': mass 1e+06 kg: no robot's link weighs that"));
  EXPECT_THAT(warned(link(testing::inertial(1, "0 0 0", "0.01", "0.01", "0.03"))),
              HasSubstr("link 'a': inertia that no body can have"));
  EXPECT_THAT(warned(link(testing::inertial(0.01, "0 0 0", "1", "1", "1"))),
              HasSubstr("inertia of a body more than 10 times as large as the link's shapes"));
  EXPECT_THAT(warned(link(testing::inertial(1, "0 120 0", "0.01", "0.01", "0.01"))),
              HasSubstr("centre of mass 120 m from its link, expected metres"));
}

TEST(UrdfPlausible, Lengths) {
  const std::string inertial = testing::inertial(1, "0 0 0", "0.01", "0.01", "0.01");
  EXPECT_THAT(warned(link(inertial, "<box size='1000 0.1 0.1'/>")),
              HasSubstr("link 'a': a shape is 1000 m long: no robot's is, expected metres"));
  EXPECT_THAT(warned(jointed("fixed", "<origin xyz='0 0 350'/>")),
              HasSubstr("joint 'j': lies 350 m from its parent, expected metres"));
  EXPECT_THAT(warned(jointed("prismatic", limited(0, 400))),
              HasSubstr("joint 'j': slides 400 m, expected metres; millimetres?"));
}

TEST(UrdfPlausible, MeshesInMillimetres) {
  TemporaryFolder folder;
  write_mesh(folder / "part.obj", 200.0);
  write_mesh(folder / "finger.obj", 5.0);
  write_mesh(folder / "dust.obj", 1e-5);
  const std::string inertial = testing::inertial(1, "0 0 0", "0.01", "0.01", "0.01");
  const auto mesh = [&](const std::string& file) {
    return link(inertial, "<mesh filename='" + file + "'/>");
  };
  const std::string urdf = (folder / "t.urdf").string();
  EXPECT_THAT(warned(mesh("part.obj"), urdf),
              HasSubstr("link 'a': mesh part.obj is 200 m long: no robot's is; is it in mm "
                        "(scale=\"0.001 0.001 0.001\")?"));
  EXPECT_THAT(warned(mesh("dust.obj"), urdf), HasSubstr("mesh dust.obj is 1e-05 m long"));
  EXPECT_THAT(warned(mesh("finger.obj") + "<link name='b'>" + inertial +
                         "</link><joint name='j' type='fixed'><parent link='a'/><child link='b'/>"
                         "<origin xyz='0 0 0.05'/></joint>",
                     urdf),
              HasSubstr("mesh finger.obj is 5 m long where all joints span 0.05 m: is it in mm"));
}

TEST(UrdfPlausible, Angles) {
  EXPECT_THAT(warned(jointed("fixed", "<origin rpy='0 0 90'/>")),
              HasSubstr("joint 'j': origin: rpy of more than a turn, expected rad; degrees?"));
  EXPECT_THAT(warned(jointed("revolute", limited(-170, 170))),
              HasSubstr("joint 'j': limits of many turns, expected rad; degrees?"));
  EXPECT_THAT(warned(jointed("revolute", limited(0, 0))),
              HasSubstr("joint 'j': lower and upper limit are the same: it cannot move"));
}

TEST(UrdfPlausible, AMovingLinkWithoutMass) {
  EXPECT_THAT(warned("<link name='a'/><link name='b'/><joint name='j' type='continuous'><parent "
                     "link='a'/><child link='b'/></joint>"),
              HasSubstr("link 'b': no mass; substitute"));
}

}  // namespace
}  // namespace pedicel::robot
