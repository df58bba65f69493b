#include "app/python/picture_thread.h"

#include <pthread.h>

#include "app/python/errors.h"
#include "engine/core/check.h"

namespace pedicel::python {

namespace {

bool drew_before_fork = false;

}  // namespace

PictureThread& PictureThread::get() {
  // Never taken apart: end() is called as the interpreter ends, and after a fork the thread of the
  // one that came along cannot be waited for.
  static PictureThread* one = new PictureThread;
  static const int of_fork = pthread_atfork(nullptr, nullptr, [] {
    // Mesa has threads of its own by then, which did not come along.
    drew_before_fork |= one->thread_.joinable();
    one = new PictureThread;
  });
  static_cast<void>(of_fork);
  return *one;
}

void PictureThread::run(const std::function<void(app::PictureTaker&)>& task) {
  if (drew_before_fork)
    throw UsageError(
        "pictures: this process was forked off one that has drawn, expected one that was started "
        "anew (multiprocessing's spawn)");
  const std::lock_guard one_caller(callers_);
  std::unique_lock lock(mutex_);
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  fault_ = nullptr;
  task_ = &task;
  changed_.notify_all();
  changed_.wait(lock, [this] { return task_ == nullptr; });
  if (fault_) std::rethrow_exception(fault_);
}

void PictureThread::end() {
  const std::lock_guard one_caller(callers_);
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
  thread_ = {};
  ends_ = false;
}

void PictureThread::work() {
  std::unique_ptr<app::PictureTaker> taker;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || task_ != nullptr; });
    if (task_ == nullptr) return;
    try {
      if (!taker) taker = std::make_unique<app::PictureTaker>();
      if (!taker->available()) throw NoPictures(taker->why());
      (*task_)(*taker);
    } catch (...) {
      fault_ = std::current_exception();
    }
    task_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace pedicel::python
