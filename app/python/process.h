#pragma once

#include <unistd.h>

#include <memory>

#include "engine/core/check.h"

namespace pedicel::python {

/// Which process something was made in: after a fork its threads are not there any more.
class Process {
 public:
  bool is_here() const { return made_in_ == getpid(); }

 private:
  pid_t made_in_ = getpid();
};

/// What has threads of its own. In a process that was forked off it can neither be used nor taken
/// apart, since both wait for those threads: it is refused, and its memory is left alone.
template <class Thing>
class Threaded {
 public:
  Threaded(std::unique_ptr<Thing> thing, bool has_threads)
      : thing_(std::move(thing)), has_threads_(has_threads) {}
  ~Threaded() {
    if (has_threads_ && !process_.is_here()) thing_.release();
  }
  Threaded(const Threaded&) = delete;
  Threaded& operator=(const Threaded&) = delete;

  Thing& operator*() const { return *thing_; }
  Thing* operator->() const { return thing_.get(); }
  /// Throws UsageError.
  void check(const char* what) const {
    if (has_threads_ && !process_.is_here())
      throw UsageError(std::string(what) +
                       " with threads was made before a fork, expected one that is made in this "
                       "process, or threads=1");
  }

 private:
  std::unique_ptr<Thing> thing_;
  bool has_threads_;
  Process process_;
};

}  // namespace pedicel::python
