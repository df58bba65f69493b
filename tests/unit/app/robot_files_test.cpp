#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "app/verbs/validate.h"
#include "engine/core/diagnostics.h"
#include "engine/geometry/primitives_mesh.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "plugins/simulation/mesh_fields.h"
#include "plugins/simulation/simulation.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

// Robots as people have them, in scenes: where they begin, and meshes of any size.
namespace pedicel::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string source(const std::string& path) {
  return pedicel::test::source_folder().string() + "/" + path;
}

/// The triangles of a box as a binary STL.
std::string box_stl(const Vec3& size) {
  const geometry::TriangleMesh mesh = geometry::make_box(size);
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) add(0.0f);
    for (const int vertex : triangle)
      for (int k = 0; k < 3; ++k) add(static_cast<float>(mesh.vertices[vertex][k]));
    add(std::uint16_t{0});
  }
  return bytes;
}

class RobotFiles : public ::testing::Test {
 protected:
  RobotFiles() { ::setenv("PEDICEL_CACHE", (folder_ / "cache").c_str(), 1); }
  ~RobotFiles() override { ::unsetenv("PEDICEL_CACHE"); }

  std::string write(const std::string& name, const std::string& text) {
    io::write_file_atomically(folder_ / name, text);
    return (folder_ / name).string();
  }
  /// A scene of a plant and a robot, with `more` in the robot's section.
  std::string scene(const std::string& urdf, const std::string& more = "") {
    return write("s.scene.yaml",
                 "format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\nduration: 0.1\nplants:\n"
                 "  - {name: p, file: " +
                     source("plants/young_plant.plant.yaml") +
                     ", position: [3, 3, 0]}\nrobot:\n  file: " + urdf + "\n" + more);
  }
  /// A robot with one moving joint whose base has a box of that size as a mesh.
  std::string robot_with_box(const Vec3& size) {
    write("box.stl", box_stl(size));
    const std::string mass =
        "<inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' "
        "iyz='0'/></inertial>";
    return write("r.urdf",
                 "<robot name='r'><link name='base'>" + mass +
                     "<collision><geometry><mesh filename='box.stl'/></geometry></collision></link>"
                     "<link name='arm'>" +
                     mass +
                     "</link><joint name='j' type='continuous'><parent link='base'/><child "
                     "link='arm'/></joint></robot>");
  }
  int validate(const std::string& file) {
    std::ostringstream out;
    const int code = validate_files({file}, {}, out);
    text_ = out.str();
    return code;
  }

  TemporaryFolder folder_;
  std::string text_;
};

TEST_F(RobotFiles, StartValuesOutsideTheLimitsAreRefusedWithTheRange) {
  const std::string urdf = source("assets/robots/stalk6/stalk6.urdf");
  EXPECT_EQ(validate(scene(urdf, "  joints:\n    joint2: 90\n    finger_joint: 1\n")), 3);
  EXPECT_THAT(text_, HasSubstr("s.scene.yaml:11:13: error: joints: joint2 = 90, expected "));
  EXPECT_THAT(text_, HasSubstr("; degrees? 90 degrees are 1.571 rad"));
  EXPECT_THAT(text_,
              HasSubstr("s.scene.yaml:12:19: error: joints: finger_joint = 1, expected 0 to "));
  EXPECT_EQ(validate(scene(urdf, "  joints: {joint2: 1.5}\n")), 0) << text_;
}

// Distance grids are for plants: a robot alone does not wait for them.
TEST_F(RobotFiles, WithoutPlantsNoDistanceGridIsBuilt) {
  const std::string urdf = robot_with_box(Vec3::Constant(0.2));
  Diagnostics diagnostics;
  const auto alone = world::read_scene(
      write(
          "alone.scene.yaml",
          "format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\nduration: 0.1\nrobot:\n  file: " +
              urdf + "\n"),
      diagnostics);
  ASSERT_TRUE(alone) << diagnostics.text();
  const simulation::Simulation simulation(*alone, {});
  EXPECT_THAT(simulation.notes(), ::testing::IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache"));
  ASSERT_EQ(simulation.colliders().size(), 1);
  EXPECT_NEAR(simulation.colliders().collider(0).shape->distance(Vec3(0.3, 0.0, 0.0)), 0.2, 1e-6);

  const auto together = world::read_scene(scene(urdf), diagnostics);
  ASSERT_TRUE(together) << diagnostics.text();
  const simulation::Simulation with_plant(*together, {});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cache"));
}

TEST_F(RobotFiles, ARobotThatCannotHoldItselfIsSaidToSag) {
  const std::string mass =
      "<inertial><origin xyz='1 0 0'/><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' "
      "ixy='0' ixz='0' iyz='0'/></inertial>";
  const std::string urdf =
      write("weak.urdf",
            "<robot name='r'><link name='base'/><link name='arm'>" + mass +
                "</link><joint name='j' type='continuous'><parent link='base'/><child "
                "link='arm'/><axis xyz='0 1 0'/><limit effort='5' velocity='1'/></joint></robot>");
  EXPECT_EQ(validate(scene(urdf)), 0) << text_;
  EXPECT_THAT(text_,
              HasSubstr("s.scene.yaml:9:3: warning: joint 'j' sags: to hold the robot at its "
                        "start takes 9.81 N m, its effort is 5 N m"));
  EXPECT_EQ(validate(scene(urdf, "  control: torque\n")), 0);
  EXPECT_THAT(text_, Not(HasSubstr("sags")));
  EXPECT_EQ(validate(scene(urdf, "  joints: {j: 1.5707963}\n")), 0);
  EXPECT_THAT(text_, Not(HasSubstr("sags"))) << "it hangs";
}

TEST_F(RobotFiles, StartValuesOfManyTurnsAreDoubted) {
  const std::string urdf = robot_with_box(Vec3::Constant(0.05));
  EXPECT_EQ(validate(scene(urdf, "  joints: {j: 90}\n")), 0) << text_;
  EXPECT_THAT(text_, HasSubstr("warning: joints: j = 90 rad are 14.3 turns; degrees?"));
  EXPECT_EQ(validate(scene(urdf, "  joints: {j: 3}\n")), 0);
  EXPECT_THAT(text_, Not(HasSubstr("turns")));
}

TEST_F(RobotFiles, RecordedPlacesOutsideTheLimitsAreRefused) {
  const std::string urdf = source("assets/robots/stalk6/stalk6.urdf");
  EXPECT_EQ(validate(scene(urdf, "  recorded:\n    - {time: 0, joints: [0, 90, 0, 0, 0, 0, 0]}\n")),
            3);
  EXPECT_THAT(text_, HasSubstr("error: recorded: at 0 s: joint2 = 90, expected "));
}

TEST_F(RobotFiles, ALargeMeshIsExactNearItAndSaidByValidateAndRun) {
  const std::string urdf = robot_with_box(Vec3(2.0, 1.0, 1.0));
  const std::string warning =
      "r.urdf: warning: link 'base': collision mesh box.stl (2 x 1 x 1 m) would take too large a "
      "grid: distances to it are exact within 10 mm, which is slow, and farther away too small by "
      "up to ";
  EXPECT_EQ(validate(urdf), 0);
  EXPECT_THAT(text_, HasSubstr(warning));
  const std::string path = scene(urdf);
  EXPECT_EQ(validate(path), 0);
  EXPECT_THAT(text_, HasSubstr(warning));

  Diagnostics diagnostics;
  const auto read = world::read_scene(path, diagnostics);
  ASSERT_TRUE(read) << diagnostics.text();
  const simulation::Simulation simulation(*read, {});
  std::string notes;
  for (const std::string& note : simulation.notes()) notes += note + "\n";
  EXPECT_THAT(notes, HasSubstr(warning));
}

TEST_F(RobotFiles, TheCachesPlaceIsSaidWhereSomethingWasBuilt) {
  const std::string path = scene(robot_with_box(Vec3::Constant(0.05)));
  EXPECT_EQ(validate(path), 0);
  EXPECT_THAT(text_, HasSubstr("distance grids built: 1, kept in " + (folder_ / "cache").string() +
                               ", at most 512 MB"));
  EXPECT_EQ(validate(path), 0);
  EXPECT_THAT(text_, Not(HasSubstr("distance grids")));
}

// All grids of a robot share one bound: small parts keep theirs, the largest give way.
TEST(MeshFields, AllGridsOfARobotShareABound) {
  robot::RobotDescription robot;
  for (int i = 0; i < 12; ++i) {
    robot::Link link;
    link.name = "link" + std::to_string(i);
    robot::Collision collision;
    collision.geometry.kind = robot::Geometry::Kind::mesh;
    collision.geometry.mesh = std::make_shared<const geometry::TriangleMesh>(
        geometry::make_box(Vec3::Constant(i < 2 ? 0.05 : 0.4)));
    link.collisions.push_back(collision);
    robot.links.push_back(link);
  }
  double samples = 0.0;
  int exact = 0;
  for (const simulation::MeshField& field : simulation::plan_mesh_fields(robot)) {
    samples += geometry::GridDistance::sample_count(field.size, field.grid);
    exact += field.exact_near;
    EXPECT_FALSE(field.exact_near && field.size.x() < 0.1);
    EXPECT_EQ(field.exact_near, field.grid.max_error > geometry::GridSettings().max_error);
  }
  EXPECT_GT(exact, 0);
  EXPECT_LT(exact, 10);
  EXPECT_LE(samples, simulation::most_robot_samples + 12 * simulation::most_coarse_samples);
  EXPECT_EQ(simulation::large_mesh_warnings(robot).size(), static_cast<std::size_t>(exact));
}

}  // namespace
}  // namespace pedicel::app
