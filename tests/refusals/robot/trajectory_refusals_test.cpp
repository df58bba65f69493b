#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/robot/cartesian_path.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using ::testing::HasSubstr;

class TrajectoryRefusals : public ::testing::Test {
 protected:
  std::string csv(const std::string& text) {
    const auto path = std::filesystem::path(::testing::TempDir()) / "refused.csv";
    std::ofstream(path) << text;
    Diagnostics diagnostics;
    EXPECT_TRUE(read_trajectory_csv(path, robot_, model_, model_.neutral(), diagnostics).empty());
    std::filesystem::remove(path);
    return diagnostics.text();
  }
  std::string path(const std::vector<Waypoint>& waypoints) {
    Diagnostics diagnostics;
    EXPECT_TRUE(plan_cartesian(model_, waypoints, model_.neutral(), {}, diagnostics).empty());
    return diagnostics.text();
  }
  static Waypoint waypoint(double time, const Vec3& position) {
    Waypoint result;
    result.time = time;
    result.tool = "tool";
    result.position_W = position;
    result.where = {"s.yaml", 7, 3};
    return result;
  }

  RobotDescription robot_ = load_urdf(testing::asset("stalk6"));
  KinematicModel model_{robot_};
};

TEST_F(TrajectoryRefusals, Csv) {
  EXPECT_THAT(csv("time,joint1\n0,0\n"),
              HasSubstr("refused.csv:1:1: error: column \"time\" has no unit, expected time_s"));
  EXPECT_THAT(csv("# c\ntime_s,joint1,elbow\n0,0,0\n"),
              HasSubstr("refused.csv:2:15: error: column \"elbow\" is unknown, expected time_s and "
                        "joints: joint1 "));
  EXPECT_THAT(csv("time_s,joint1,joint1\n0,0,0\n"),
              HasSubstr("refused.csv:1:15: error: column joint1 appears twice"));
  EXPECT_THAT(csv("time_s,finger_joint_mirror\n0,0\n"),
              HasSubstr("joint 'finger_joint_mirror' follows 'finger_joint', expected that one"));
  EXPECT_THAT(csv("time_s,joint5\n0,0\n1,3\n"),
              HasSubstr("refused.csv:3:3: error: joint5 = 3, expected -2.1642 to 2.1642"));
  EXPECT_THAT(csv("time_s,joint1\n1,0\n1,0\n"), HasSubstr("does not increase"));
  EXPECT_THAT(csv("time_s,joint5\n0,0\n1,3\n2,3\n"), HasSubstr("(and 1 more like it, the last"));
  EXPECT_THAT(csv("time_s,joint1 (N)\n0,0\n"),
              HasSubstr("column \"joint1 (N)\" is in \"N\", expected rad or deg"));
  EXPECT_THAT(csv("time_s,joint1\n0,nan\n"), HasSubstr("\"nan\" is not a finite number"));
}

TEST_F(TrajectoryRefusals, WaypointNames) {
  EXPECT_THAT(path({}), HasSubstr("no waypoints, expected at least one"));
  Waypoint tool = waypoint(1, {0.25, 0, 0.3});
  tool.tool = "hand";
  EXPECT_THAT(path({tool}), HasSubstr("s.yaml:7:3: error: waypoint 1 (t = 1 s): no link 'hand'"));
  Waypoint joint = waypoint(1, {0.25, 0, 0.3});
  joint.joints = {{"thumb", 0.0}};
  EXPECT_THAT(path({joint}), HasSubstr("waypoint 1 (t = 1 s): unknown joint 'thumb'"));
  joint.joints = {{"finger_joint", 0.1}};
  EXPECT_THAT(path({joint}), HasSubstr("finger_joint = 0.1, expected 0 to 0.025"));
  EXPECT_THAT(path({waypoint(1, {0.25, 0, 0.3}), waypoint(1, {0.25, 0, 0.3})}),
              HasSubstr("waypoint 2 (t = 1 s): time does not increase, expected more than 1"));
}

TEST_F(TrajectoryRefusals, WaypointsOutOfReach) {
  EXPECT_THAT(path({waypoint(2, {0.25, 0, 0.3}), waypoint(4, {2, 0, 0.3})}),
              HasSubstr("s.yaml:7:3: error: waypoint 2 (t = 4 s): unreachable: nearest reachable "
                        "point is 1.3"));
}

TEST_F(TrajectoryRefusals, PathsThatAreTooFast) {
  EXPECT_THAT(path({waypoint(2, {0.25, 0.1, 0.3}), waypoint(2.05, {0.25, -0.1, 0.3})}),
              HasSubstr("waypoint 2 (t = 2.05 s): too fast: at t = "));
}

// Straight from one side of the base to the other leads through the base's own axis, which the tool
// cannot cross at that height with its approach kept.
TEST_F(TrajectoryRefusals, PathsThatLeaveTheReach) {
  Waypoint a = waypoint(5, {0.3, 0, 0.1}), b = waypoint(15, {-0.3, 0, 0.1});
  a.approach_W = b.approach_W = -Vec3::UnitZ();
  EXPECT_THAT(path({a, b}), HasSubstr("waypoint 2 (t = 15 s): "));
}

}  // namespace
}  // namespace pedicel::robot
