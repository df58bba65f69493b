#include "core/thread_pool.h"

#include <algorithm>

#include "core/check.h"

namespace pedicel {

namespace {

// Some half a millisecond: longer than one thread of a step waits for another. True as soon as
// `ready` is.
template <class Ready>
bool becomes_ready_soon(const Ready& ready) {
  for (unsigned turn = 0; turn < 8192; ++turn) {
    if (ready()) return true;
    wait_a_moment(turn);
  }
  return false;
}

}  // namespace

// Leaves the core's other thread and the memory bus alone, and lets others have the core at times.
void wait_a_moment(unsigned turn) {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
  if (turn % 512 == 511) std::this_thread::yield();
}

ThreadPool::ThreadPool(int threads) : begun_(std::max(0, threads)) {
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
  count_ = count;
  call_ = call;
  object_ = object;
  for (int i = 0; i < threads(); ++i) begun_[i].store(i >= count, std::memory_order_relaxed);
  next_.store(threads(), std::memory_order_relaxed);
  busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  {
    std::lock_guard lock(mutex_);  // whoever is falling asleep has either seen the call or waits
  }
  wake_.notify_all();
  take_tasks(0);
  const auto done = [this] { return busy_.load(std::memory_order_acquire) == 0; };
  if (becomes_ready_soon(done)) return;
  std::unique_lock lock(mutex_);
  done_.wait(lock, done);
}

void ThreadPool::take_tasks(int thread) {
  const auto begin = [this](int i) {
    if (!begun_[i].exchange(true, std::memory_order_relaxed)) call_(object_, i);
  };
  begin(thread);
  for (int i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) call_(object_, i);
  for (int i = 0; i < threads(); ++i) begin(i);
}

void ThreadPool::work(int thread) {
  unsigned seen = 0;
  const auto called = [&] {
    return stop_.load(std::memory_order_acquire) ||
           generation_.load(std::memory_order_acquire) != seen;
  };
  while (true) {
    if (!becomes_ready_soon(called)) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, called);
    }
    if (stop_) return;
    ++seen;
    take_tasks(thread);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) > 1) continue;
    std::lock_guard lock(mutex_);
    done_.notify_one();
  }
}

}  // namespace pedicel
