// The robot in a scene that was built by hand: what it would run into at its goal, fruits that it
// takes off, and what is said where it does not.
#include <gmock/gmock.h>

#include "app/session/live/pick_program.h"
#include "app/session/live/robot_contacts.h"
#include "app/session/live/robot_goal.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class RobotTakes : public ::testing::Test {
 protected:
  RobotTakes() : session(waiting()) {}
  void run(const std::string& line) { must(session.run_text(line)); }
  /// What the robot runs into on its way to a place of the tool.
  std::string hits(const std::string& place) {
    run("tool " + place);
    const auto now = session.snapshot();
    const auto ghost = robot_ghost(*now);
    return ghost ? contacts.at_goal(*now, ghost->links) : "no ghost";
  }
  bool is_on(const std::string& organ) {
    const auto now = session.snapshot();
    try {
      find_fruit(*now, organ);
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }
  /// As a stranger draws a truss: thin, soft, its fruits low on a bow.
  void soft_truss() {
    for (const char* line :
         {"new plant plant",
          "draw stem plant stem 0,0,0;0.0078,0.0046,0.301;0.0203,0.0119,0.578 "
          "0.004,0.0027,0.0015",
          "draw stem plant branch 0.0131,0.0077,0.4277;0.0442,0.0259,0.4431;0.083,0.0487,0.4507;"
          "0.1221,0.0716,0.4431;0.1485,0.087,0.4277 0.00215,0.00183,0.00146,0.00109,0.00081",
          "draw stem plant stalk 0.1417,0.083,0.432;0.1494,0.0875,0.389 0.00088,0.00033",
          "add fruit plant berry stalk 0.965 0.012 density=1000 stretch=0.15 force=3"})
      run(line);
    run("add robot " + urdf);
  }
  const std::string urdf = source("assets/robots/stalk6/stalk6.urdf").string();
  Session session;
  RobotContacts contacts;
};

TEST_F(RobotTakes, WhatStandsAtTheGoalIsNamed) {
  run("add robot " + urdf + " position=0,0,0");
  const Vec3 tool = session.snapshot()->robot.tool.position;
  const std::string place = std::to_string(tool.x()) + "," + std::to_string(tool.y()) + ",";
  const std::string up = place + std::to_string(tool.z() + 0.25);
  EXPECT_EQ(hits(up), "");
  run("add box crate 0.1,0.1,0.1 position=" + up);
  EXPECT_THAT(hits(up), HasSubstr("into crate"));
  run("delete body crate");
  EXPECT_EQ(hits(up), "");
}

TEST_F(RobotTakes, TheGroundAtTheGoalIsNamed) {
  run("add robot " + urdf + " position=0,0,0");
  const Vec3 tool = session.snapshot()->robot.tool.position;
  EXPECT_THAT(hits(std::to_string(tool.x()) + "," + std::to_string(tool.y()) + ",-0.05"),
              HasSubstr("the ground"));
}

// A root frame without a shape stands for what is bolted to it.
TEST_F(RobotTakes, TheLinkThatHasTheShapeIsNamed) {
  TemporaryFolder folder;
  io::write_file_atomically(folder / "arm.urdf", R"(<robot name="arm">
  <link name="frame"/>
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="rod"/>
  <link name="hand"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0"
    ixz="0" iyz="0"/></inertial><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="bolt" type="fixed"><parent link="frame"/><child link="base"/></joint>
  <joint name="lift" type="prismatic"><parent link="frame"/><child link="rod"/>
    <origin xyz="0 0 0.3"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="100" velocity="1"/></joint>
  <joint name="turn" type="revolute"><parent link="rod"/><child link="hand"/><origin xyz="0.1 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="100" velocity="1"/></joint>
</robot>)");
  run("add robot " + (folder / "arm.urdf").string() + " position=0,0,1 tool=hand");
  run("joint lift -0.25");
  const auto now = session.snapshot();
  const auto ghost = robot_ghost(*now);
  ASSERT_TRUE(ghost);
  EXPECT_EQ(contacts.at_goal(*now, ghost->links), "hand into base");
}

TEST_F(RobotTakes, AFruitOfASoftTrussComesOff) {
  soft_truss();
  run("pick plant/berry");
  run("run 10");
  EXPECT_FALSE(is_on("plant/berry"));
}

TEST_F(RobotTakes, AFruitThatStaysOnIsSaid) {
  soft_truss();
  run("pick plant/berry pull=0,0,0.02");
  run("run 20");
  session.update();
  ASSERT_TRUE(is_on("plant/berry"));
  ASSERT_FALSE(session.messages().all().empty());
  EXPECT_THAT(session.messages().all().back().text, HasSubstr("plant/berry was not taken off"));
}

TEST_F(RobotTakes, UndoTakesBackThePick) {
  soft_truss();
  run("run 0.1");
  const std::uint64_t before = session.control().state_hash();
  const std::size_t edits = session.history().size();
  run("pick plant/berry");
  run("run 10");
  run("undo");
  EXPECT_EQ(session.control().state_hash(), before);
  EXPECT_EQ(session.history().size(), edits) << "no edit went";
  run("run 3");
  EXPECT_TRUE(is_on("plant/berry")) << "and it is not taken off again";
}

}  // namespace
}  // namespace pedicel::app
