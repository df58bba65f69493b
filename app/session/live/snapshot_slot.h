#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>

#include "app/session/live/snapshot.h"

namespace pedicel::app {

/// Where the simulation's thread puts its newest step for all others: a pointer that is swapped, so
/// that neither side waits for the other.
class SnapshotSlot {
 public:
  SnapshotSlot();

  /// The newest; never null. From any thread.
  std::shared_ptr<const Snapshot> take();

  // On the simulation's thread.
  void put(std::shared_ptr<const Snapshot> snapshot);
  /// Whether it is time for another: sooner where the last one was taken.
  bool wants_another() const;
  bool is_older_than(std::chrono::milliseconds age) const;

 private:
  std::mutex mutex_;
  std::shared_ptr<const Snapshot> newest_;
  std::atomic<bool> taken_{true};
  std::chrono::steady_clock::time_point put_;
};

}  // namespace pedicel::app
