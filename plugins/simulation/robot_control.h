#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/state_hash.h"
#include "engine/robot/robot.h"
#include "engine/robot/trajectory.h"
#include "engine/world/scene.h"
#include "engine/world/sim_world.h"
#include "plugins/simulation/drive_error.h"
#include "plugins/simulation/followed_program.h"

namespace pedicel::simulation {

/// Where recorded joints are at a time (s): of all, rad or m, and rad/s or m/s.
using JointReadings = std::function<void(double time, Eigen::VectorXd& q, Eigen::VectorXd& qd)>;

/// A link takes hold of an organ, or lets go of it.
struct Grasp {
  double time = 0.0;  ///< s
  bool takes = true;  ///< false: lets go
  std::string what;   ///< a fruit or a curve of any plant
  int link = 0;       ///< of the robot, that takes it
};

/// The scene's robot and the program it follows.
class RobotControl : public world::Participant {
 public:
  /// `moves`: as robot::RobotSettings has it. Throws UsageError where the description does not fit
  /// the world (nothing moves).
  RobotControl(const world::SceneRobot& scene, const robot::RobotDescription& description,
               world::SimWorld& world, bool moves = true);

  world::Phase phase() const override { return world::Phase::control; }
  /// Sets the program's targets for the end of this step and hands them to Bullet.
  void act(world::SimWorld& world, world::WorldReport& report) override;
  /// After Bullet's part of the step: reads where the robot is now. To be added to the world before
  /// the plants.
  world::Participant& reader() { return reader_; }

  const std::string& name() const { return name_; }
  const robot::Robot& robot() const { return robot_; }
  robot::Robot& robot() { return robot_; }
  const robot::RobotDescription& description() const { return robot_.description(); }
  Pose link_pose(int link) const { return robot_.link_pose_W(link); }
  const std::vector<Pose>& link_poses() const { return robot_.link_poses(); }
  /// Index of the joint that the scene calls the gripper; -1: none.
  int gripper() const { return gripper_; }
  /// rad or m, of all joints when the step at hand began.
  const Eigen::VectorXd& start_of_step() const { return start_of_step_; }
  int tool_link() const { return tool_link_; }
  /// X_W of the tool: the link that waypoints move, with the scene's offset.
  Pose tool_pose() const;
  /// To be followed; its time 0 is at `start` (s) of the world.
  void set_trajectory(robot::Trajectory trajectory, double start = 0.0) {
    set_program({std::move(trajectory), {}, start});
  }
  void set_program(FollowedProgram program) {
    program_ = std::move(program);
    goal_.reset();
    led_ = false;
  }
  /// Gives up the program or the goal: it stays where it is now.
  void stop() { go_to(robot_.positions()); }
  /// How its drives differ from what they are told and what is read of them.
  DriveError& drives() { return drives_; }
  /// What a joint's encoder reads, rad or m.
  double reading(int joint) const { return drives_.reading(joint, robot_.positions()[joint]); }
  /// Gives up the program: from where it is, every joint moves evenly to `q` (rad or m,
  /// moved into the limits), at its speed limit at most, at 1 rad/s or 0.25 m/s where that is
  /// lower.
  void go_to(const Eigen::VectorXd& q);
  /// Gives up the program or the goal: from now on the motors do what robot().motors() is told, as
  /// long as nothing else is asked for.
  void lead_by_motors();
  bool led_by_motors() const { return led_; }
  /// From now on all joints are where the readings say at the end of each step, whatever acts on
  /// them; at once, too.
  void lead_by_readings(JointReadings readings);
  bool led_by_readings() const { return static_cast<bool>(readings_); }
  /// Where it is told to go in the end (rad or m); led by its motors, where it is.
  Eigen::VectorXd goal() const;
  bool follows_program() const { return !program_.empty() && !goal_; }
  /// What set_trajectory() or set_program() said, also while a goal goes before it.
  const FollowedProgram& program() const { return program_; }

  void add_to(StateHash& hash) const { robot_.add_to(hash); }

 private:
  class Reader : public world::Participant {
   public:
    explicit Reader(RobotControl& control) : control_(control) {}
    world::Phase phase() const override { return world::Phase::plants; }
    void act(world::SimWorld& world, world::WorldReport& report) override;

   private:
    RobotControl& control_;
  };

  std::string name_, mode_;
  robot::Robot robot_;
  Reader reader_;
  void approach_goal(double dt);

  FollowedProgram program_;
  std::optional<Eigen::VectorXd> goal_;  // of go_to()
  Eigen::VectorXd speed_;                // rad/s or m/s, of go_to()
  bool led_ = false;                     // by its motors
  int tool_link_ = 0, gripper_ = -1;
  Vec3 tool_offset_;
  Eigen::VectorXd q_, qd_, start_of_step_;
  DriveError drives_;
  JointReadings readings_;  // none: it is led otherwise
};

/// What leads a scene's robot beside its program, and what effects change of it.
struct LedRobot {
  const robot::RobotDescription* believed = nullptr;  ///< that programs are planned for; null: it
  double log_delay = 0.0;  ///< s: a row of its trajectory's file at t holds what was at t - delay
  double lag = 0.0;        ///< s, DriveError::set_lag()
  JointReadings readings;  ///< in place of its program; none: the program
  bool moves = true;       ///< robot::RobotSettings
};

/// How fast each joint goes where it is sent by hand, rad/s or m/s.
Eigen::VectorXd manual_speed(const robot::KinematicModel& model,
                             const robot::RobotDescription& description);

/// Reads the robot's files. Faults (an unreadable file, a joint of the scene that is not there) go
/// to `diagnostics`, and then nothing comes back. `packages`: "NAME=PATH" beside the scene's own.
std::optional<robot::RobotDescription> read_robot(const world::SceneRobot& scene,
                                                  const std::vector<std::string>& packages,
                                                  Diagnostics& diagnostics);

/// Puts the robot that read_robot() read into the world and plans its program. Faults (a waypoint
/// that cannot be reached) go to `diagnostics`, and then nothing comes back. `find` tells where a
/// scene's anchor is.
std::unique_ptr<RobotControl> make_robot_control(
    const world::SceneRobot& scene, const robot::RobotDescription& description,
    world::SimWorld& world, const std::function<std::optional<Vec3>(const world::Anchor&)>& find,
    const LedRobot& led, Diagnostics& diagnostics);

}  // namespace pedicel::simulation
