#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"
#include "tests/unit/robot/robot_cases.h"

// The files that a URDF names: what is missing is left out and said once a package, names written
// for other systems are read.
namespace pedicel::robot {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class UrdfMeshes : public ::testing::Test {
 protected:
  void SetUp() override { write("ws/arm/urdf/meshes/Base_Link.obj", tetrahedron); }

  fs::path write(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  /// One link 'base' of that name's mesh, and what was said.
  std::optional<RobotDescription> read(const std::string& mesh, const char* kind = "collision") {
    return parse("<link name='base'>" + mass + shape(kind, mesh) + "</link>");
  }
  std::optional<RobotDescription> parse(const std::string& inside) {
    Diagnostics diagnostics;
    auto robot = parse_urdf("<robot name='r'>\n" + inside + "</robot>",
                            folder_ / "ws/arm/urdf/arm.urdf", {}, diagnostics);
    said = diagnostics.text();
    lines = diagnostics.all().size();
    return robot;
  }
  static std::string shape(const std::string& kind, const std::string& mesh) {
    return "<" + kind + "><geometry><mesh filename='" + mesh + "'/></geometry></" + kind + ">\n";
  }
  /// Whether the mesh was found and loaded.
  bool loads(const std::string& mesh) {
    const auto robot = read(mesh);
    return robot && robot->links[0].collisions.size() == 1;
  }

  static inline const std::string tetrahedron =
      "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  static inline const std::string mass = testing::inertial(1.0, "0 0 0", "0.01", "0.01", "0.01");
  TemporaryFolder folder_;
  std::string said;
  std::size_t lines = 0;
};

TEST_F(UrdfMeshes, NamesOfOtherSystemsAreRead) {
  write("ws/arm/urdf/meshes/two words.obj", tetrahedron);
  for (const std::string name :
       {"meshes/Base_Link.obj", "meshes\\Base_Link.obj", "package:///arm/urdf/meshes/Base_Link.obj",
        "package://arm/urdf/meshes/Base_Link.obj", "model://arm/urdf/meshes/Base_Link.obj",
        "model:///arm/urdf\\meshes\\Base_Link.obj", "package://arm/urdf//meshes/Base_Link.obj",
        "meshes/two words.obj", "meshes/two%20words.obj",
        "package://arm/urdf/meshes/two%20words.obj", "file://meshes/Base_Link.obj"}) {
    EXPECT_TRUE(loads(name)) << name << "\n" << said;
    EXPECT_EQ(said, "") << name;
  }
  const std::string absolute = (folder_ / "ws/arm/urdf/meshes/Base_Link.obj").string();
  EXPECT_TRUE(loads("file://" + absolute));
  EXPECT_TRUE(loads("file://localhost" + absolute));
  EXPECT_TRUE(loads(absolute));
}

TEST_F(UrdfMeshes, ANameThatDiffersInCaseIsTakenAndSaid) {
  for (const std::string name :
       {"meshes/base_link.obj", "meshes/BASE_LINK.OBJ", "Meshes/Base_Link.obj",
        "package://ARM/urdf/meshes/base_link.obj"}) {
    EXPECT_TRUE(loads(name)) << name << "\n" << said;
    EXPECT_THAT(said, HasSubstr("Base_Link.obj is there and taken; their names differ in upper "
                                "and lower case"))
        << name;
  }
  write("ws/arm/urdf/meshes/BASE_link.obj", tetrahedron);
  EXPECT_FALSE(loads("meshes/base_link.obj"));  // which of the two?
}

TEST_F(UrdfMeshes, AMissingVisualIsLeftOutAndAMissingCollisionNamesTheLink) {
  auto robot = read("meshes/none.obj", "visual");
  ASSERT_TRUE(robot) << said;
  EXPECT_TRUE(robot->links[0].visuals.empty());
  EXPECT_THAT(said, HasSubstr("arm.urdf:2:"));
  EXPECT_THAT(said, HasSubstr("warning: mesh file \"meshes/none.obj\" of link 'base': not found, "
                              "looked for "));
  EXPECT_THAT(said, HasSubstr("; not drawn"));
  robot = read("meshes/none.obj");
  ASSERT_TRUE(robot) << said;
  EXPECT_TRUE(robot->links[0].collisions.empty());
  EXPECT_THAT(said, HasSubstr("; no contact there of base"));
}

TEST_F(UrdfMeshes, MissingFilesAreSaidOnceAPackageWithACount) {
  std::string links, joints;
  for (int i = 0; i < 20; ++i) {
    const std::string name = "l" + std::to_string(i);
    links += "<link name='" + name + "'>" + mass +
             shape("visual", "package:///hand/" + name + ".dae") +
             shape("collision", "package:///hand/" + name + ".stl") +
             shape("visual", "package://head/face.dae") + "</link>";
    if (i > 0)
      joints += "<joint name='j" + name + "' type='fixed'><parent link='l0'/><child link='" + name +
                "'/></joint>";
  }
  ASSERT_TRUE(parse(links + joints)) << said;
  EXPECT_EQ(lines, 2u) << said;
  EXPECT_THAT(said, HasSubstr("warning: package 'hand': 40 mesh files, first "
                              "\"package:///hand/l0.dae\" of link 'l0': not found"));
  EXPECT_THAT(said, HasSubstr("no contact there of l0, l1, l2 and 17 more; say where the package "
                              "is with --package hand=PATH"));
  EXPECT_THAT(said,
              HasSubstr("package 'head': mesh file \"package://head/face.dae\" of link 'l0'"));
  EXPECT_LT(said.size(), 1500u);
}

TEST_F(UrdfMeshes, TheAdviceFitsWhatIsThere) {
  read("package://hand/a.obj");
  EXPECT_THAT(said, HasSubstr("say where the package is with --package hand=PATH"));
  read("package://arm/a.obj");
  EXPECT_THAT(said, HasSubstr("the package is in " + (folder_ / "ws/arm").string() +
                              ", without that file"));
  EXPECT_THAT(said, Not(HasSubstr("--package")));
  read("package:///");
  EXPECT_THAT(said, HasSubstr("expected package://NAME/FILE"));
  read("model://a.obj");
  EXPECT_THAT(said, HasSubstr("expected model://NAME/FILE"));
  EXPECT_THAT(said, Not(HasSubstr("--package")));
  read("a.obj");
  EXPECT_THAT(said, Not(HasSubstr("package")));
}

TEST_F(UrdfMeshes, AGitLfsPointerIsMissingWithTheCommandThatFetchesIt) {
  write("ws/arm/urdf/meshes/a.stl",
        "version https://git-lfs.github.com/spec/v1\noid sha256:aaaa\nsize 12345\n");
  for (const char* kind : {"visual", "collision"}) {
    ASSERT_TRUE(read("meshes/a.stl", kind)) << said;
    EXPECT_THAT(said, HasSubstr("warning: mesh file \"meshes/a.stl\" of link 'base': a Git LFS "
                                "pointer: run git lfs pull"));
    EXPECT_THAT(said, Not(HasSubstr("looked for")));
  }
}

TEST_F(UrdfMeshes, ADamagedMeshIsAnErrorWhereItIsTouchedAndAWarningWhereItIsSeen) {
  write("ws/arm/urdf/meshes/a.stl", std::string(83, 'x'));
  EXPECT_TRUE(read("meshes/a.stl", "visual"));
  EXPECT_THAT(said, HasSubstr("warning: link 'base': mesh \"meshes/a.stl\": cut off: 83 bytes"));
  EXPECT_THAT(said, HasSubstr("; not drawn"));
  EXPECT_FALSE(read("meshes/a.stl"));
  EXPECT_THAT(said, HasSubstr("error: link 'base': collision: mesh \"meshes/a.stl\": cut off"));
}

TEST_F(UrdfMeshes, AMovingLinkWhoseMeshAndMassAreMissingGetsTheSmallSphere) {
  const auto robot = parse(
      "<link name='base'/><link name='tip'>" + shape("collision", "none.stl") +
      "</link><joint name='j' type='continuous'><parent link='base'/><child link='tip'/></joint>");
  ASSERT_TRUE(robot) << said;
  EXPECT_GT(robot->links[1].inertial.mass, 0.0);
  EXPECT_THAT(said, HasSubstr("link 'tip': no mass; substitute"));
}

}  // namespace
}  // namespace pedicel::robot
