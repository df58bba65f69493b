#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "app/session/live/instability.h"
#include "app/session/live/kept_steps.h"
#include "app/session/live/run_clock.h"
#include "app/session/live/run_control.h"
#include "app/session/live/run_rates.h"
#include "app/session/live/snapshot_maker.h"
#include "app/session/live/snapshot_slot.h"

namespace pedicel::app {

/// A run as it is played: forward, back, held and shown. All of it happens on the simulation's
/// thread, but for `snapshots`, `log` and stop_replay().
class RunPlayer {
 public:
  /// Simulates something else from now on. Faults are in what comes back; the run stays then.
  BuildNews build(const MakeAssets& make, std::uint64_t document_hash, bool restart);

  void play();
  void pause();
  void advance(long steps);
  void go_to(long step);
  void reset();
  void set_speed(double speed);
  void hold_at(std::optional<double> time);
  void act(LiveRun::Input input);
  /// The run, at the step that is shown; null: there is none.
  LiveRun* run();
  /// The step that is shown.
  long position() const { return shown_.value_or(run_ ? run_->steps() : 0); }

  /// Whether there are steps that somebody waits for: those asked for, and playing to a hold.
  bool has_steps() const;
  /// Whether nothing is to be done.
  bool is_at_rest() const { return is_held() || (to_do_ == 0 && mode_ != RunMode::playing); }
  /// When the next step is; nothing: at once. Not at rest.
  std::optional<RunClock::Wall::time_point> due() const;
  /// Does one. Not at rest.
  void step();

  /// Hands over a snapshot, if it is time or `now`.
  void publish(bool now);
  /// Ends one that is going on, from any thread; for good.
  void stop_replay() { stopping_ = true; }

  SnapshotSlot snapshots;
  RunLog log;

 private:
  void take_assets(const std::shared_ptr<const simulation::SceneAssets>& assets, bool restart);
  void begin_anew();
  void replay_to(long step);
  bool show(long step);
  void keep_step() { kept_.add(maker_.make(*run_)); }
  bool keeps_steps() const;
  bool is_held() const { return run_ && clock_.is_held(time()); }
  double time() const { return run_ ? run_->simulation().world().time() : 0.0; }
  std::shared_ptr<Snapshot> snapshot();
  void fill_state(Snapshot& snapshot) const;

  std::unique_ptr<LiveRun> run_;
  SnapshotMaker maker_;
  // The last steps of stepping, of a replay, and of playing where that costs little. While one is
  // shown, the run stands where it stood, and goes there when it is needed.
  KeptSteps kept_;
  std::optional<long> shown_;
  RunClock clock_;
  RunRates rates_;
  RunMode mode_ = RunMode::empty;
  long to_do_ = 0;  // steps, then it pauses
  double replay_share_ = 0.0;
  Instability instability_;
  std::uint64_t document_hash_ = 0;
  std::atomic<bool> stopping_{false};
};

}  // namespace pedicel::app
