#include "app/session/live/snapshot_slot.h"

#include <utility>

namespace pedicel::app {

namespace {

/// Between snapshots, and between those that nobody looks at.
constexpr std::chrono::milliseconds frame{16}, idle_frame{100};

}  // namespace

SnapshotSlot::SnapshotSlot() : newest_(std::make_shared<const Snapshot>()) {}

std::shared_ptr<const Snapshot> SnapshotSlot::take() {
  taken_ = true;
  const std::lock_guard lock(mutex_);
  return newest_;
}

void SnapshotSlot::put(std::shared_ptr<const Snapshot> snapshot) {
  put_ = std::chrono::steady_clock::now();
  taken_ = false;
  std::shared_ptr<const Snapshot> old;  // goes once the lock is open: it may be large
  const std::lock_guard lock(mutex_);
  old = std::exchange(newest_, std::move(snapshot));
}

bool SnapshotSlot::wants_another() const {
  return is_older_than(taken_ ? frame : idle_frame);
}

bool SnapshotSlot::is_older_than(std::chrono::milliseconds age) const {
  return std::chrono::steady_clock::now() - put_ > age;
}

}  // namespace pedicel::app
