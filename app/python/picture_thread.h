#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "app/draw/pictures.h"

namespace pedicel::python {

/// The one thread that draws: an off-screen context stays current on the thread that made it, and
/// Python may ask from any.
class PictureThread {
 public:
  /// A process that was forked off has one of its own.
  static PictureThread& get();

  /// Runs `task` there, and waits for it. Passes on what it throws. Throws NoPictures where there
  /// is no OpenGL off screen. Without the interpreter's lock.
  void run(const std::function<void(app::PictureTaker&)>& task);
  /// Ends the thread; the next run() starts it again.
  void end();

 private:
  void work();

  std::mutex callers_, mutex_;
  std::condition_variable changed_;
  const std::function<void(app::PictureTaker&)>* task_ = nullptr;
  std::exception_ptr fault_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace pedicel::python
