#include "engine/robot/read/read_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

class ReadRobot : public ::testing::Test {
 protected:
  std::optional<RobotDescription> read(const std::string& name, const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / name;
    std::ofstream(file) << text;
    Diagnostics diagnostics;
    auto robot = read_robot(file, {}, diagnostics);
    said_ = diagnostics.text();
    return robot;
  }

  const std::string arm_ = "<robot name='arm'><link name='base'/></robot>";
  std::string said_;
};

TEST_F(ReadRobot, KnowsAFormatByItsExtension) {
  for (const std::string name : {"door.urdf", "door.URDF", "door.xacro"}) {
    EXPECT_TRUE(is_robot_name(name));
    ASSERT_TRUE(read(name, arm_)) << said_;
    EXPECT_FALSE(read(name, "<world/>"));
    EXPECT_THAT(said_, HasSubstr("expected <robot name="));
  }
}

TEST_F(ReadRobot, KnowsAFormatByItsTextWhereTheExtensionSaysNothing) {
  for (const std::string name : {"door.xml", "door"}) {
    EXPECT_FALSE(is_robot_name(name));
    ASSERT_TRUE(read(name, "<?xml version='1.0'?>\n" + arm_)) << said_;
  }
}

TEST_F(ReadRobot, SaysWhichFormatsThereAre) {
  const std::string words =
      "error: kind of robot file is unknown, expected one of: URDF (.urdf, .xacro)";
  EXPECT_FALSE(read("door.txt", "a <robot> in a sentence"));
  EXPECT_THAT(said_, HasSubstr("door.txt: " + words));
  EXPECT_FALSE(read("door.xml", "<world/>"));
  EXPECT_THAT(said_, HasSubstr("door.xml: " + words));
  Diagnostics diagnostics;
  EXPECT_FALSE(read_robot("/nowhere/door", {}, diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("/nowhere/door: error: "));
}

}  // namespace
}  // namespace pedicel::robot
