#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "app/ros/arm_actions.h"
#include "app/ros/command_queue.h"
#include "app/ros/entities.h"
#include "app/ros/joint_follower.h"
#include "app/ros/ros_sink.h"
#include "app/ros/scene_edits.h"
#include "app/topics/both_sinks.h"
#include "app/topics/mcap_log.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

struct RosOptions {
  NodeOptions node;
  simulation::SimulationOptions simulation;
  double pace = 1.0;               ///< simulated seconds a second; 0: as fast as it can
  bool paused = false;             ///< waits for a step or for play
  std::optional<double> duration;  ///< s, simulated; absent: until it is stopped
  std::filesystem::path log;       ///< *.mcap; empty: none
  bool pictures = true;            ///< of the scene's cameras
  bool quiet = false;
};

/// A simulation that is a node of ROS 2: it tells its topics, follows trajectories, and answers the
/// services of simulation_interfaces.
class RosServer {
 public:
  /// Throws InvalidFile for a scene that cannot be built, std::runtime_error where DDS refuses, and
  /// io::WriteError.
  RosServer(const world::Scene& scene, const RosOptions& options);
  ~RosServer();

  /// Until it is stopped, has run for its duration, or is unstable: the exit code.
  int run();

 private:
  friend class RosServices;
  enum class State { playing, paused, stopped };
  void begin();
  /// The scene as edited, at time 0: false, with the reason, where it cannot be built, and then
  /// nothing has changed.
  bool rebuild(const SceneEdits& edits, std::string& fault);
  /// False where it cannot go on.
  bool step();
  void wait_for_pace();
  bool is_over() const;
  void follow(const ros::JointTrajectory& message);
  void refuse(const std::string& what, const std::string& why);
  void say_end() const;

  RosOptions options_;
  SceneEdits edits_;
  std::shared_ptr<const simulation::SceneAssets> assets_;
  std::unique_ptr<simulation::Simulation> simulation_;
  std::unique_ptr<JointFollower> follower_;  // null: no robot
  CommandQueue queue_;
  std::unique_ptr<PictureTaker> taker_;  // null: no cameras
  State state_ = State::playing;
  bool quits_ = false;
  std::string failure_;
  std::uint64_t malformed_ = 0;
  double pace_wall_ = 0.0, pace_time_ = 0.0;  // s, where pacing counts from
  // Last, so that nothing arrives any more once the rest goes.
  std::unique_ptr<DdsNode> node_;
  std::unique_ptr<RosSink> sink_;
  std::unique_ptr<McapSink> log_;    // null: none
  std::unique_ptr<BothSinks> both_;  // the two before; null where there is no log
  std::unique_ptr<SimulationTopics> told_;
  std::unique_ptr<class RosServices> services_;
  std::unique_ptr<ArmActions> actions_;  // null: no robot
};

}  // namespace pedicel::app
