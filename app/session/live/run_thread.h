#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "app/session/live/run_player.h"

namespace pedicel::app {

/// The simulation's thread: takes what RunControl asks for from any thread, and does it between two
/// steps of its player.
class RunThread {
 public:
  using Request = std::function<void(RunPlayer&)>;
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
  std::shared_ptr<const Snapshot> snapshot() { return player_.snapshots.take(); }
  std::vector<BuildNews> take_news();
  double building_for() const;
  RunLog& log() { return player_.log; }

 private:
  void loop();
  bool take_request();
  void guarded(const Request& request);
  bool has_work() const;
  void wait_for_work(std::unique_lock<std::mutex>& lock);
  void step_if_due();
  void do_build(const Build& build);
  void tell(BuildNews news);

  // Shared, under the mutex.
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::deque<Request> requests_;
  std::optional<Build> build_;
  std::vector<BuildNews> news_;
  bool stop_ = false, busy_ = false, working_ = false;             // working_: the player has steps
  std::atomic<std::chrono::steady_clock::rep> building_since_{0};  // 0: nothing is built

  RunPlayer player_;  // the thread's own, but for what it says
  std::thread thread_;
};

}  // namespace pedicel::app
