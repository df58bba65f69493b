#pragma once

#include <atomic>
#include <limits>
#include <thread>

namespace pedicel::discrepancy {

/// When a search must end: once the caller asks for it, or after a time. Until release() the flag
/// follows both; from then on it stays false, so that what is known can still be concluded.
class Deadline {
 public:
  /// `stop` may be null.
  Deadline(const std::atomic<bool>* stop, double seconds);

  const std::atomic<bool>* flag() const { return &over_; }
  /// Whether the search was ended.
  bool release();

 private:
  std::atomic<bool> over_ = false;
  std::jthread watch_;
};

}  // namespace pedicel::discrepancy
