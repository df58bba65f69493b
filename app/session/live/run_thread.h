#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "pedicel/app/session/live/run_control.h"
#include "pedicel/app/session/live/run_rates.h"
#include "pedicel/app/session/live/snapshot_maker.h"

namespace pedicel::app {

/// The simulation's thread. What RunControl asks for is done here, between two steps.
class RunThread {
 public:
  using Request = std::function<void(RunThread&)>;
  struct Build {
    MakeAssets make;
    std::uint64_t document_hash = 0;
    bool restart = false;
  };

  RunThread();
  ~RunThread();

  // From any thread.
  void ask(Request request);
  void ask_build(Build build);
  void wait();
  std::shared_ptr<const Snapshot> snapshot();
  std::vector<BuildNews> take_news();
  double building_for() const;
  RunLog log;

  // On the thread itself.
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

 private:
  /// Steps that are kept to be shown again.
  static constexpr long most_kept = 120;
  /// Elements of a run that keeps them while it plays, too: more would take a tenth of a step.
  static constexpr int most_elements_kept = 600;

  void loop();
  bool take_request();
  void guarded(const Request& request);
  bool has_work() const;
  bool has_steps() const;
  bool is_held() const;
  void wait_for_work(std::unique_lock<std::mutex>& lock);
  void do_build(Build build);
  void take_assets(const std::shared_ptr<const SceneAssets>& assets, bool restart);
  void one_step();
  void replay_to(long step);
  bool show(long step);
  void keep_step();
  void keep_anew();
  bool keeps_steps() const;
  void check_stability();
  void start_clock();
  void publish(bool now);
  void hand_over(std::shared_ptr<Snapshot> snapshot);
  void fill_state(Snapshot& snapshot) const;
  std::chrono::steady_clock::time_point due() const;

  // Shared, under the mutex.
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::deque<Request> requests_;
  std::optional<Build> build_;
  std::vector<BuildNews> news_;
  bool stop_ = false, busy_ = false, working_ = false;  // working_: has_steps()
  std::mutex snapshot_mutex_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::atomic<bool> taken_{true};
  std::atomic<bool> stopping_{false};
  std::atomic<std::chrono::steady_clock::rep> building_since_{0};  // 0: nothing is built

  // The thread's own.
  std::unique_ptr<LiveRun> run_;
  SnapshotMaker maker_;
  // Steps that may be shown again without running to them: the last ones of stepping, of a replay,
  // and of playing where that costs little. While one is shown, the run stands where it stood, and
  // goes there when it is needed.
  std::deque<std::shared_ptr<const Snapshot>> kept_;
  std::optional<long> shown_;
  RunRates rates_;
  RunMode mode_ = RunMode::empty;
  long to_do_ = 0;  // steps, then it pauses
  double speed_ = 1.0, replay_share_ = 0.0, last_good_time_ = 0.0;
  std::string error_, culprit_;
  int culprit_plant_ = -1, culprit_element_ = -1;
  std::uint64_t document_hash_ = 0;
  std::chrono::steady_clock::time_point clock_start_, last_publish_;
  double clock_time_ = 0.0;     // s, simulated, at clock_start_
  std::optional<double> held_;  // s: steps wait there
  std::thread thread_;
};

}  // namespace pedicel::app
