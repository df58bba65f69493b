#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace pedicel::app {

/// Work on a thread of its own that can be asked to stop. What it makes it hands over by itself.
class BackgroundJob {
 public:
  /// `work` is to return soon once the flag is set. What it throws becomes fault().
  using Work = std::function<void(const std::atomic<bool>& stop)>;

  explicit BackgroundJob(Work work);
  /// Asks it to stop and waits for it.
  ~BackgroundJob();
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  /// Asks it to stop; does not wait.
  void stop() { stop_ = true; }
  bool was_stopped() const { return stop_; }
  bool has_ended() const { return ended_; }
  /// Why it failed; empty: it did not. To be read once it has ended.
  const std::string& fault() const { return fault_; }

 private:
  void run(const Work& work);

  std::atomic<bool> stop_{false}, ended_{false};
  std::string fault_;
  std::thread thread_;
};

}  // namespace pedicel::app
