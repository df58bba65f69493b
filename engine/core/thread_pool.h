#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace pedicel {

/// One turn of a loop that waits awake, the `turn`th.
void wait_a_moment(unsigned turn);

/// Waits awake until `ready()`: for what another thread is about to finish.
template <class Ready>
void await(const Ready& ready) {
  for (unsigned turn = 0; !ready(); ++turn) wait_a_moment(turn);
}

/// Likewise, but for so many turns at most. Whether it is ready.
template <class Ready>
bool await(const Ready& ready, unsigned turns) {
  for (unsigned turn = 0; turn < turns; ++turn) {
    if (ready()) return true;
    wait_a_moment(turn);
  }
  return false;
}

/// Runs independent tasks on a fixed number of threads. Which thread takes which task is not
/// fixed, so tasks must not depend on each other: then any number of threads gives the same bits.
/// Task i of the first threads() is thread i's unless another one is idle before it comes to it:
/// what the same task of an earlier call worked on mostly still lies in that core's cache. Threads
/// wait for the next call awake for half a millisecond or so, since waking one costs as much as a
/// small task, and sleep after that.
class ThreadPool {
 public:
  /// `threads` counts the caller; 1 runs everything in the caller's thread.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls task(i) for i in [0, count) and returns when all are done. Does not allocate. `task`
  /// must not throw.
  template <class Task>
  void for_each(int count, const Task& task) {
    run(
        count, [](const void* object, int i) { (*static_cast<const Task*>(object))(i); }, &task);
  }

 private:
  using Call = void (*)(const void*, int);
  // What one thread writes and another one reads goes from core to core a line of the cache at a
  // time, which takes as long as some hundred multiplications. So each has lines of its own.
  struct alignas(64) Job {
    std::atomic<unsigned> generation{0};  // of the call
    int count = 0;
    Call call = nullptr;
    const void* object = nullptr;
  };
  struct alignas(64) Mark {
    std::atomic<unsigned> generation{0};
  };

  void run(int count, Call call, const void* object);
  void work(int thread);
  void take_tasks(int thread, unsigned generation);
  void take_own_task(int thread, unsigned generation);
  void take_left_tasks(unsigned generation);
  bool all_done(unsigned generation) const;

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  alignas(64) std::atomic<int> asleep_{0};  // workers
  std::atomic<bool> caller_sleeps_{false};
  Job job_;
  std::vector<Mark> begun_;     // by thread: the last call whose task of that number somebody took
  std::vector<Mark> finished_;  // by thread: the last call that it had nothing left to do of
  alignas(64) std::atomic<int> next_{0};  // of the other tasks
  alignas(64) std::atomic<bool> stop_{false};
};

}  // namespace pedicel
