#include "engine/urdf/package_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/core/check.h"

namespace pedicel::robot {
namespace {

namespace fs = std::filesystem;

class PackagePathsTest : public ::testing::Test {
 protected:
  PackagePathsTest()
      : root_(fs::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~PackagePathsTest() override { fs::remove_all(root_); }

  fs::path touch(const std::string& path) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << "x";
    return root_ / path;
  }
  fs::path found(const PackagePaths& paths, const std::string& uri) {
    return paths.find(uri, root_ / "ws/arm/urdf/arm.urdf").file.value_or("");
  }

  fs::path root_;
};

TEST_F(PackagePathsTest, TheListByHandWinsAndIsFinal) {
  touch("ws/arm/mesh.stl");
  const fs::path other = touch("other/mesh.stl");
  PackagePaths paths;
  paths.add("arm=" + (root_ / "other").string());
  EXPECT_EQ(found(paths, "package://arm/mesh.stl"), other);
  paths.add("arm=" + (root_ / "nowhere").string());
  EXPECT_EQ(found(paths, "package://arm/mesh.stl"), "");
}

TEST_F(PackagePathsTest, RosPathHoldsPackagesOrIsOne) {
  const fs::path mesh = touch("ros/hand/mesh.stl");
  PackagePaths paths;
  paths.add_ros_path("/nowhere:" + (root_ / "ros").string());
  EXPECT_EQ(found(paths, "package://hand/mesh.stl"), mesh);
  PackagePaths direct;
  direct.add_ros_path((root_ / "ros/hand").string());
  EXPECT_EQ(found(direct, "package://hand/mesh.stl"), mesh);
}

TEST_F(PackagePathsTest, AmentPrefixesHoldShareFolders) {
  const fs::path mesh = touch("install/share/hand/meshes/mesh.stl");
  PackagePaths paths;
  paths.add_ament_path((root_ / "install").string());
  EXPECT_EQ(found(paths, "package://hand/meshes/mesh.stl"), mesh);
}

TEST_F(PackagePathsTest, ReadsTheEnvironment) {
  const fs::path ros = touch("ros/hand/a.stl"), ament = touch("install/share/hand/b.stl");
  setenv("ROS_PACKAGE_PATH", (root_ / "ros").c_str(), 1);
  setenv("AMENT_PREFIX_PATH", (root_ / "install").c_str(), 1);
  const PackagePaths paths = PackagePaths::from_environment();
  unsetenv("ROS_PACKAGE_PATH");
  unsetenv("AMENT_PREFIX_PATH");
  EXPECT_EQ(found(paths, "package://hand/a.stl"), ros);
  EXPECT_EQ(found(paths, "package://hand/b.stl"), ament);
}

TEST_F(PackagePathsTest, ParentFoldersAreTheLastResort) {
  const fs::path own = touch("ws/arm/meshes/a.stl"), beside = touch("ws/hand/b.stl");
  EXPECT_EQ(found({}, "package://arm/meshes/a.stl"), own);
  EXPECT_EQ(found({}, "package://hand/b.stl"), beside);
}

TEST_F(PackagePathsTest, FileAndRelativeNames) {
  const fs::path mesh = touch("ws/arm/urdf/meshes/a.stl");
  EXPECT_EQ(found({}, "meshes/a.stl"), mesh);
  EXPECT_EQ(found({}, "file://meshes/a.stl"), mesh);
  EXPECT_EQ(found({}, "file://" + mesh.string()), mesh);
  EXPECT_EQ(found({}, mesh.string()), mesh);
}

TEST_F(PackagePathsTest, NamesEveryPlaceThatItLookedAt) {
  PackagePaths paths;
  paths.add_ros_path("/ros");
  paths.add_ament_path("/ament");
  const auto result = paths.find("package://hand/a.stl", root_ / "arm.urdf");
  EXPECT_FALSE(result.file);
  EXPECT_THAT(result.looked_at,
              ::testing::IsSupersetOf({fs::path("/ros/hand/a.stl"),
                                       fs::path("/ament/share/hand/a.stl"), root_ / "hand/a.stl"}));
}

TEST_F(PackagePathsTest, RefusesAListThatIsNoList) {
  PackagePaths paths;
  EXPECT_THROW(paths.add("hand"), UsageError);
  EXPECT_THROW(paths.add("=/path"), UsageError);
  EXPECT_THROW(paths.add("hand="), UsageError);
}

}  // namespace
}  // namespace pedicel::robot
