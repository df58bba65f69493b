#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/unit/robot/robot_cases.h"

// Each rule of the URDF reader with the smallest file that breaks it, and the words it answers
// with.
namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

std::string refused(const std::string& text, const std::string& file = "t.urdf") {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_urdf(text, file, {}, diagnostics));
  return diagnostics.text();
}

std::string robot(const std::string& inside) {
  return "<robot name='r'>" + inside + "</robot>";
}

/// Links a and b and a joint between them with `inside` in it.
std::string jointed(const std::string& inside, const std::string& type = "revolute") {
  return robot("<link name='a'/><link name='b'/>\n<joint name='j' type='" + type +
               "'><parent link='a'/><child link='b'/>" + inside + "</joint>");
}

const std::string limit = "<limit lower='0' upper='1' effort='1' velocity='1'/>";

std::string massive(const std::string& mass, const std::string& ixx = "1",
                    const std::string& origin = "") {
  return robot("<link name='a'><inertial>" + origin + mass + "<inertia ixx='" + ixx +
               "' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>");
}

std::string shaped(const std::string& shape) {
  return robot("<link name='a'>\n<collision><geometry>" + shape + "</geometry></collision></link>");
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

struct Case {
  std::string name, text, words;
};

class UrdfRule : public ::testing::TestWithParam<Case> {};

TEST_P(UrdfRule, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refused(GetParam().text), HasSubstr(GetParam().words));
}

const Case file_cases[] = {
    {"Empty", "", "t.urdf: error: an empty file, expected a URDF"},
    {"LfsPointer", "version https://git-lfs.github.com/spec/v1\noid sha256:aa\nsize 12\n",
     "t.urdf: error: a Git LFS pointer: run git lfs pull"},
    {"Utf16", std::string("\xff\xfe<\0r\0o\0", 8), "t.urdf: error: UTF-16: save as UTF-8"},
    {"Utf16WithoutMark", std::string("<\0r\0o\0", 6), "UTF-16: save as UTF-8"},
    {"Utf16BigEndian", std::string("\0<\0r\0o", 6), "UTF-16: save as UTF-8"},
    {"Binary", std::string("<robot>\0", 8), "a binary file, expected a URDF"},
    {"EntitiesWithoutEnd",
     "<!DOCTYPE robot [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>"
     "<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;'><!ENTITY d '&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;'>"
     "<!ENTITY e '&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;'><!ENTITY f '&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;'>"
     "<!ENTITY g '&f;&f;&f;&f;&f;&f;&f;&f;&f;&f;'><!ENTITY h '&g;&g;&g;&g;&g;&g;&g;&g;&g;&g;'>]>"
     "<robot name='&h;'/>",
     "its entities make more than 64 MB of text"},
    {"TooDeep", robot("<link name='a'><!-- <a> > --><b c='>'/>" + repeated("<a>", 300)),
     "elements within elements, more than 200 levels deep, expected a URDF"},
    {"Packed", "\x1F\x8B\x08 robot", "compressed with gzip, expected the text in it"},
    {"NotXml", "hello", "t.urdf:1:1: error: not XML: "},
    {"Unclosed", "<robot name='r'>\n<link name='a'>", "not XML: "},
    {"OtherXml", "<sdf/>", "t.urdf:1:1: error: <sdf> as the first element, expected <robot name="},
    {"NoLink", robot(""), "t.urdf:1:1: error: no link, expected at least one"},
    {"Xacro",
     robot("<link name='a'>\n<visual><geometry><sphere radius='${r}'/>"
           "</geometry></visual></link>"),
     "t.urdf:2:27: error: \"${r}\" is an unexpanded xacro, expected plain URDF: run `xacro t.urdf "
     "-o "
     "t.expanded.urdf`"},
    {"XacroMacro", robot("<xacro:arm/>"), "\"xacro:arm\" is an unexpanded xacro"},
};
const Case link_cases[] = {
    {"LinkWithoutName", robot("<link/>"), "t.urdf:1:17: error: link: no name"},
    {"DuplicateLink", robot("<link name='a'/>\n<link name='a'/>"),
     "t.urdf:2:7: error: duplicate link 'a', expected each name once"},
    {"NoMass", massive(""), "link 'a': inertial without <mass>"},
    {"NoInertia", robot("<link name='a'><inertial><mass value='1'/></inertial></link>"),
     "link 'a': inertial without <inertia>"},
    {"MassIsText", massive("<mass value='heavy'/>"),
     "link 'a': mass: value \"heavy\" is not a finite number"},
    {"MassIsNan", massive("<mass value='nan'/>"), "value \"nan\" is not a finite number"},
    {"MassIsInfinite", massive("<mass value='inf'/>"), "value \"inf\" is not a finite number"},
    {"MassIsNegative", massive("<mass value='-1'/>"),
     "link 'a': mass: value \"-1\", expected 0 or more"},
    {"MassHasAComma", massive("<mass value='0,5'/>"),
     "\"0,5\" is not a finite number, expected a point, not a comma"},
    {"BadInertia", massive("<mass value='1'/>", "x"),
     "link 'a': inertia: ixx \"x\" is not a finite number"},
    {"BadOrigin", massive("<mass value='1'/>", "1", "<origin xyz='0 0'/>"),
     "link 'a': inertial: origin: xyz \"0 0\" has 2 numbers, expected 3"},
    {"CommaInOrigin", massive("<mass value='1'/>", "1", "<origin xyz='0,1 0 0'/>"),
     "expected a point, not a comma"},
    {"OriginBeyondNumbers", massive("<mass value='1'/>", "1", "<origin xyz='1e300 0 0'/>"),
     "origin: xyz \"1e300 0 0\", expected m, each a number between -10000000 and 10000000"},
    {"MassBeyondNumbers", massive("<mass value='1e300'/>"),
     "value \"1e300\", expected at most 1e+09"},
    {"SphereBeyondNumbers", shaped("<sphere radius='1e300'/>"),
     "sphere: radius \"1e300\", expected at most 10000000"},
    {"BoxBeyondNumbers", shaped("<box size='1 1e300 1'/>"), "expected at most 10000000 m"},
    {"CommasBetweenNumbers", massive("<mass value='1'/>", "1", "<origin xyz='0,0,1'/>"),
     "xyz \"0,0,1\" has commas, expected 3 numbers separated by blanks"},
    {"CommasAndBlanks", massive("<mass value='1'/>", "1", "<origin xyz='0, 0, 1'/>"),
     "xyz \"0, 0, 1\" has commas, expected 3 numbers separated by blanks"},
    {"NoGeometry", robot("<link name='a'><visual/></link>"), "link 'a': visual: no geometry"},
    {"CylinderWithoutLength", shaped("<cylinder radius='1'/>"), "cylinder: no length"},
    {"BoxOfTwoNumbers", shaped("<box size='1 1'/>"), "box: size \"1 1\" has 2 numbers, expected 3"},
    {"NegativeSphere", shaped("<sphere radius='-1'/>"),
     "t.urdf:2:30: error: link 'a': collision: sphere: radius \"-1\", expected 0 or more"},
    {"NegativeCapsule", shaped("<capsule radius='1' length='-1'/>"),
     "capsule: length \"-1\", expected 0 or more"},
    {"CapsuleWithoutRadius", shaped("<capsule length='1'/>"), "capsule: no radius"},
    {"NegativeBox", shaped("<box size='1 1 -1'/>"), "box size \"1 1 -1\", expected 0 or more"},
    {"UnknownShape", shaped("<cone radius='1'/>"),
     "unknown geometry <cone>, expected box, cylinder, sphere, capsule or mesh"},
    {"MeshWithoutName", shaped("<mesh/>"), "mesh: no filename"},
    {"ScaleOfZero", shaped("<mesh filename='a.stl' scale='1 0 1'/>"), "scale 0, expected no zero"},
    {"QuaternionOfNoLength", massive("<mass value='1'/>", "1", "<origin quat_xyzw='0 0 0 0'/>"),
     "link 'a': inertial: origin: quat_xyzw of length 0, expected a rotation such as 0 0 0 1"},
    {"TwoRotations", massive("<mass value='1'/>", "1", "<origin rpy='0 0 1' quat_xyzw='0 0 0 1'/>"),
     "quat_xyzw beside rpy, expected one of them"},
};
const Case joint_cases[] = {
    {"JointWithoutName", robot("<link name='a'/><joint type='fixed'/>"), "joint: no name"},
    {"DuplicateJoint",
     robot("<link name='a'/><link name='b'/><link name='c'/>"
           "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
           "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>"),
     "duplicate joint 'j'"},
    {"JointWithoutType",
     robot("<link name='a'/><link name='b'/><joint name='j'><parent link='a'/>"
           "<child link='b'/></joint>"),
     "joint 'j': no type"},
    {"UnknownType", jointed("", "ball"),
     "t.urdf:2:17: error: joint 'j': unknown joint type 'ball', expected fixed, revolute, "
     "continuous "
     "or prismatic"},
    {"FloatingJoint", jointed("", "floating"),
     "joint 'j': joint type 'floating' is not supported, expected fixed, revolute"},
    {"PlanarJoint", jointed("", "planar"),
     "joint 'j': joint type 'planar' is not supported, expected fixed, revolute"},
    {"RevoluteWithoutLimit", jointed(""),
     "t.urdf:2:1: error: joint 'j': revolute joint without <limit>"},
    {"PrismaticWithoutLimit", jointed("", "prismatic"), "prismatic joint without <limit>"},
    {"NegativeVelocity", jointed("<limit lower='0' upper='1' effort='1' velocity='-2'/>"),
     "joint 'j': limit: velocity \"-2\", expected 0 or more, or -1 for no limit"},
    {"ZeroAxis", jointed("<axis xyz='0 0 0'/>" + limit),
     "axis of length 0, expected a direction such as 0 0 1"},
    {"BadAxis", jointed("<axis xyz='0 0 up'/>" + limit), "axis: xyz \"up\" is not a finite number"},
    {"BadJointOrigin", jointed("<origin rpy='0 0 0 0'/>" + limit),
     "rpy \"0 0 0 0\" has 4 numbers, expected 3"},
    {"NegativeDamping", jointed(limit + "<dynamics damping='-1'/>"),
     "damping \"-1\", expected 0 or more"},
    {"NegativeFriction", jointed(limit + "<dynamics friction='-1'/>"),
     "friction \"-1\", expected 0 or more"},
    {"EmptyDynamics", jointed(limit + "<dynamics/>"),
     "empty <dynamics>, expected damping or friction"},
    {"UnknownMimic", jointed(limit + "<mimic joint='k'/>"),
     "joint 'j': mimic of the unknown joint 'k', expected a joint of this file"},
    {"MimicOfItself", jointed(limit + "<mimic joint='j'/>"), "mimic joints in a circle"},
    {"MimicOfFixed",
     robot("<link name='a'/><link name='b'/><link name='c'/>"
           "<joint name='f' type='fixed'><parent link='a'/><child link='b'/></joint>"
           "<joint name='j' type='continuous'><parent link='b'/><child link='c'/>"
           "<mimic joint='f'/></joint>"),
     "mimic of the fixed joint 'f'"},
};
const Case tree_cases[] = {
    {"TwoRoots", robot("<link name='a'/>\n<link name='b'/>"),
     "t.urdf:2:1: error: two roots: links 'a' and 'b' have no parent joint, expected one root"},
    {"Cycle",
     robot("<link name='a'/><link name='b'/>\n"
           "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n"
           "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint>"),
     "t.urdf:3:1: error: link 'a' is its own ancestor, expected a tree without a cycle"},
    {"TwoParents",
     robot("<link name='a'/><link name='b'/><link name='c'/>"
           "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>"
           "<joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>"),
     "link 'c' is the child of two joints, expected one parent"},
    {"MissingChild",
     robot("<link name='a'/><joint name='j' type='fixed'><parent link='a'/>"
           "<child link='z'/></joint>"),
     "joint 'j': child link 'z' does not exist, expected a link of this file"},
    {"NoParent", robot("<link name='a'/><joint name='j' type='fixed'><child link='a'/></joint>"),
     "joint 'j': no <parent>"},
};

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(File, UrdfRule, ::testing::ValuesIn(file_cases), case_name);
INSTANTIATE_TEST_SUITE_P(Link, UrdfRule, ::testing::ValuesIn(link_cases), case_name);
INSTANTIATE_TEST_SUITE_P(Joint, UrdfRule, ::testing::ValuesIn(joint_cases), case_name);
INSTANTIATE_TEST_SUITE_P(Tree, UrdfRule, ::testing::ValuesIn(tree_cases), case_name);

TEST(UrdfRefusals, EveryFaultIsReportedAtOnce) {
  const std::string text = refused(robot("<link name='a'/><link name='a'/><link/>"));
  EXPECT_THAT(text, HasSubstr("duplicate link 'a'"));
  EXPECT_THAT(text, HasSubstr("link: no name"));
}

TEST(UrdfRefusals, TheXacroCommandNamesTheFilesInQuestion) {
  EXPECT_THAT(refused(robot("<link name='${n}'/>"), "arms/arm.urdf.xacro"),
              HasSubstr("run `xacro arms/arm.urdf.xacro -o arms/arm.urdf` and load that file"));
  EXPECT_THAT(refused(robot("<link name='$(arg n)'/>"), "arm.xacro"),
              HasSubstr("run `xacro arm.xacro -o arm.urdf`"));
}

TEST(UrdfRefusals, AMeshThatCannotBeReadIsReportedAtItsLink) {
  const auto folder = pedicel::test::source_folder() / "tests/refusals/robot";
  Diagnostics diagnostics;
  EXPECT_FALSE(
      parse_urdf(shaped("<mesh filename='CMakeLists.txt'/>"), folder / "t.urdf", {}, diagnostics));
  EXPECT_THAT(diagnostics.text(),
              HasSubstr("t.urdf:2:28: error: link 'a': collision: mesh \"CMakeLists.txt\": "));
}

TEST(UrdfRefusals, AMissingFile) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_urdf("nowhere.urdf", {}, diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("nowhere.urdf: error: cannot be read"));
  EXPECT_THROW(load_urdf("nowhere.urdf"), InvalidFile);
}

}  // namespace
}  // namespace pedicel::robot
