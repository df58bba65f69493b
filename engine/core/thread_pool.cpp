#include "core/thread_pool.h"

#include "core/check.h"

namespace pedicel {

ThreadPool::ThreadPool(int threads) {
  if (threads < 1) throw UsageError("threads = " + std::to_string(threads) + ": must be >= 1");
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
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
  {
    std::lock_guard lock(mutex_);
    count_ = count;
    call_ = call;
    object_ = object;
    next_.store(0, std::memory_order_relaxed);
    busy_ = static_cast<int>(workers_.size());
    ++generation_;
  }
  wake_.notify_all();
  for (int i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count;) call(object, i);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void ThreadPool::work() {
  unsigned seen = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || generation_ != seen; });
      if (stop_) return;
      seen = generation_;
    }
    for (int i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) call_(object_, i);
    std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace pedicel
