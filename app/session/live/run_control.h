#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/live/run_log.h"
#include "app/session/live/snapshot.h"
#include "engine/robot/trajectory.h"

namespace pedicel::app {

struct PullPlace;

/// Makes what is to be simulated; runs on the simulation's thread. Throws InvalidFile, UsageError.
using MakeAssets = std::function<std::shared_ptr<const simulation::SceneAssets>()>;

/// What became of a build, told once.
struct BuildNews {
  std::uint64_t document_hash = 0;
  bool built = false;
  bool restarted = false;            ///< from time 0; else the running one was changed
  std::vector<Diagnostic> problems;  ///< why not
  std::vector<std::string> notes;    ///< what a user should know
};

/// The simulation on a thread of its own. Every call returns at once; the thread does what it is
/// told between two steps, in order, and never waits for who looks: snapshots are made when the
/// last one was taken and by time, and handed over by swapping a pointer.
class RunControl {
 public:
  RunControl();
  ~RunControl();
  RunControl(const RunControl&) = delete;
  RunControl& operator=(const RunControl&) = delete;

  /// Simulates something else. Where only constants differ (stiffness, thresholds, solver settings)
  /// the running simulation goes on with them; else it starts anew from time 0. Of several builds
  /// that wait the newest counts. What cannot be built leaves the simulation as it is.
  void build(MakeAssets make, std::uint64_t document_hash, bool restart = false);

  void play();
  void pause();
  /// Steps forward and pauses.
  void step(long count = 1);
  /// So much simulated time (s) forward, then pauses.
  void run_for(double duration);
  /// Back by so many steps, exactly: runs anew from time 0 with everything that was done since, and
  /// pauses. The last steps of stepping, of such a run and, in small scenes, of playing are kept to
  /// be shown again at once. What was done after stays for stepping forward until something else is
  /// done.
  void step_back(long count = 1);
  /// To a step of the run, either way.
  void go_to_step(long step);
  /// To a step before this one; what was done to the run since (pulls, robot) is forgotten, so that
  /// playing on does not do it again.
  void take_back_to(long step);
  /// Back to time 0; what was done to the run (pulls, robot) is forgotten, the plants stay.
  void reset();
  /// Simulated s a wall s; 0: as fast as it goes.
  void set_speed(double speed);
  /// Steps go to that time (s) as fast as they can, playing ones too, and then wait until another
  /// one is told; wait() waits for that. Without a time nothing is held, and playing goes by the
  /// clock.
  void hold_at(std::optional<double> time);

  void begin_pull(const PullPlace& place, const Vec3& target_W);
  void move_pull(const Vec3& target_W);
  void end_pull();
  /// Cuts a stem at a fraction of its length from its foot, or a fruit's stalk (Cutting::cut).
  /// Nothing happens where that has come off by then.
  void cut(const std::string& organ, double at);

  /// Moves the joints there, each at its speed limit or a little less; q: rad or m, one a degree of
  /// freedom.
  void move_robot(const Eigen::VectorXd& q);
  /// Plays joint positions over time, from now on.
  void play_trajectory(robot::Trajectory trajectory);
  /// The same, and then a lap over and over.
  void play_loop(robot::Trajectory lead, robot::Trajectory lap);
  /// The robot stays where it is.
  void stop_robot();

  /// How long (s) what was asked for last is being built; 0: nothing is.
  double building_for() const;
  /// The newest complete step; never null.
  std::shared_ptr<const Snapshot> snapshot() const;
  std::vector<BuildNews> take_news();

  /// Quantities of the run over its time, and the loads of the organ that is watched.
  RunLog& log();
  const RunLog& log() const;

  /// Waits until everything asked for is done: scripts and tests, not windows. Playing counts as
  /// done.
  void wait() const;
  /// Of the simulation now, between two steps; waits.
  std::uint64_t state_hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pedicel::app
