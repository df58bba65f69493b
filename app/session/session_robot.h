#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/session/commands/command.h"
#include "app/session/live/robot_goal.h"
#include "app/session/live/snapshot.h"
#include "app/session/result.h"
#include "engine/robot/inverse_kinematics.h"
#include "engine/robot/trajectory.h"

namespace pedicel::app {

struct SessionCore;

/// The robot by hand, and what it plays. What is asked of it where the scene has none is a
/// UsageError.
class SessionRobot {
 public:
  explicit SessionRobot(SessionCore& core) : core_(core) {}

  /// Joint positions with which the tool is at a pose (without `turned`: at its place, turned
  /// anyhow); `reached` false and a sentence where it cannot be. Starts from the goal that the
  /// robot has.
  robot::IkResult reach(const Pose& tool_W, bool turned = true) const;
  /// Where the tool was asked to go, and whether it can; where the robot was told otherwise since,
  /// the tool's place at the end of that. Nothing without a robot.
  std::optional<ToolGoal> tool_goal() const;
  /// Moves the tool to a pose. `turned`: its turn was asked for, too; else an arm with fewer than
  /// six joints may turn it. Where the pose is out of reach: refused with the sentence, or as near
  /// as can be, and the answer has the sentence.
  Result aim_tool(const Pose& tool_W, bool turned, bool as_near_as_can_be);
  /// Moves the tool by a shift (m, W) and a turn (rad, a rotation vector, W), or says why not.
  Result jog(const Vec3& shift_W, const Vec3& turn_W = Vec3::Zero());
  /// Moves one joint, the gripper or all joints (rad or m). Throws UsageError.
  Result move_joint(const std::string& name, double value);
  Result move_gripper(double value);
  Result move_joints(const Eigen::VectorXd& q);
  /// Moves all joints to where they stand at time 0.
  Result home();
  /// Whether somebody leads the robot by hand, rather than that it follows what the scene says.
  bool is_led() const;

  /// Leads the tool to a fruit (PLANT/FRUIT), shuts the gripper on it and pulls it from there by
  /// `pull_W` (m); without that up, as far as the arm comes.
  Result pick(const std::string& organ, const std::optional<Vec3>& pull_W = {});
  /// Plays the recorded waypoints from now on; with `loops` over and over until it is stopped: the
  /// way back to the first takes the time that the joints need by hand.
  Result play_waypoints(bool loops = false);
  /// Of a table time_s,joint,... ; its time 0 is now.
  Result play_trajectory(const std::filesystem::path& file, bool loops = false);
  /// Ends what the robot plays.
  Result stop();
  /// The waypoints as such a table.
  Result save_waypoints(const std::filesystem::path& file) const;
  /// Takes the rows of such a table as the waypoints, as one step of the history.
  Result load_waypoints(const std::filesystem::path& file);

  /// The command `add robot` with all that it leaves out, by what the scene has.
  Command complete(const Command& add_robot) const;
  /// Says what became of a pick; once a frame.
  void update();

 private:
  /// A fruit that the robot is taking off.
  struct Picked {
    std::string organ;
    std::uint64_t stage = 0;  // of the simulation
    long step = 0;
    double end = 0.0;  // s, of the pull
  };
  /// The last pose asked for.
  struct Aim {
    ToolGoal goal;
    Eigen::VectorXd to;                   // rad or m
    std::uint64_t stage = 0, number = 0;  // of the snapshot it was asked at
    long step = 0;
  };
  std::shared_ptr<const Snapshot> snapshot() const;
  Result play(robot::Trajectory trajectory, bool loops);
  robot::Trajectory waypoint_trajectory(const robot::KinematicModel& model) const;

  SessionCore& core_;
  std::optional<Aim> aim_;
  std::optional<Picked> picked_;
};

}  // namespace pedicel::app
