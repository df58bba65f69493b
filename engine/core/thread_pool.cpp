#include "engine/core/thread_pool.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel {

namespace {

// Some half a millisecond: longer than one thread of a step waits for another; and a few
// microseconds, in which a thread that is awake has begun.
constexpr unsigned half_a_millisecond = 8192, microseconds = 128;  // turns

}  // namespace

// Leaves the core's other thread and the memory bus alone, and lets others have the core at times.
void wait_a_moment(unsigned turn) {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
  if (turn % 512 == 511) std::this_thread::yield();
}

ThreadPool::ThreadPool(int threads)
    : begun_(std::max(0, threads)), finished_(std::max(0, threads)) {
  if (threads < 1) throw UsageError("threads = " + std::to_string(threads) + ": must be >= 1");
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this, i] { work(i); });
}

ThreadPool::~ThreadPool() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(int count, Call call, const void* object) {
  if (workers_.empty() || count < 2) {
    for (int i = 0; i < count; ++i) call(object, i);
    return;
  }
  const unsigned generation = job_.generation.load(std::memory_order_relaxed) + 1;
  job_.count = count;
  job_.call = call;
  job_.object = object;
  if (count > threads()) next_.store(threads(), std::memory_order_relaxed);
  job_.generation.store(generation);
  if (asleep_.load() > 0) {
    std::lock_guard lock(mutex_);  // whoever is falling asleep has either seen the call or waits
    wake_.notify_all();
  }
  take_tasks(0, generation);
  const auto done = [&] { return all_done(generation); };
  if (await(done, microseconds)) return;
  take_left_tasks(generation);
  if (await(done, half_a_millisecond)) return;
  std::unique_lock lock(mutex_);
  caller_sleeps_.store(true);
  done_.wait(lock, done);
  caller_sleeps_.store(false);
}

bool ThreadPool::all_done(unsigned generation) const {
  for (int i = 1; i < threads(); ++i)
    if (finished_[i].generation.load() != generation) return false;
  return true;
}

void ThreadPool::take_tasks(int thread, unsigned generation) {
  take_own_task(thread, generation);
  if (job_.count <= threads()) return;
  for (int i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < job_.count;)
    job_.call(job_.object, i);
}

void ThreadPool::take_own_task(int thread, unsigned generation) {
  if (thread >= job_.count) return;
  if (begun_[thread].generation.exchange(generation, std::memory_order_relaxed) != generation)
    job_.call(job_.object, thread);
}

// Those of threads that are still asleep.
void ThreadPool::take_left_tasks(unsigned generation) {
  for (int i = 1; i < threads(); ++i) take_own_task(i, generation);
}

void ThreadPool::work(int thread) {
  unsigned seen = 0;
  const auto called = [&] {
    return stop_.load(std::memory_order_relaxed) || job_.generation.load() != seen;
  };
  while (true) {
    if (!await(called, half_a_millisecond)) {
      std::unique_lock lock(mutex_);
      asleep_.fetch_add(1);
      wake_.wait(lock, called);
      asleep_.fetch_sub(1);
    }
    if (stop_) return;
    ++seen;
    take_tasks(thread, seen);
    finished_[thread].generation.store(seen);
    if (!caller_sleeps_.load()) continue;
    std::lock_guard lock(mutex_);
    done_.notify_one();
  }
}

}  // namespace pedicel
