#include "pedicel/app/python/picture_thread.h"

#include "pedicel/app/python/errors.h"

namespace pedicel::python {

PictureThread& PictureThread::get() {
  static PictureThread one;
  return one;
}

PictureThread::~PictureThread() {
  end();
}

void PictureThread::run(const std::function<void(app::PictureTaker&)>& task) {
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
