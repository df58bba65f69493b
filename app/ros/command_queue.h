#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

namespace pedicel::app {

/// What arrives on other threads, to be done on the simulation's own. Bounded: what comes beyond is
/// refused and counted.
class CommandQueue {
 public:
  static constexpr std::size_t longest = 1000;

  void put(std::function<void()> command) {
    {
      const std::lock_guard lock(mutex_);
      if (all_.size() >= longest) {
        ++refused_;
        return;
      }
      all_.push_back(std::move(command));
    }
    there_.notify_one();
  }

  /// Does all that is there.
  void run() {
    std::deque<std::function<void()>> now;
    {
      const std::lock_guard lock(mutex_);
      now.swap(all_);
    }
    for (const auto& command : now) command();
  }

  /// Until something is there, or so many seconds have passed.
  void wait(double seconds) {
    std::unique_lock lock(mutex_);
    there_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return !all_.empty(); });
  }

  std::uint64_t refused() const { return refused_; }

 private:
  std::mutex mutex_;
  std::condition_variable there_;
  std::deque<std::function<void()>> all_;
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace pedicel::app
