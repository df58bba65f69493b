#pragma once

#include <deque>
#include <memory>

#include "app/session/live/snapshot.h"

namespace pedicel::app {

/// The last steps of a run, without a gap, to be shown again without running to them.
class KeptSteps {
 public:
  static constexpr long most = 120;

  /// A step that does not follow the last one takes the place of all.
  void add(std::shared_ptr<const Snapshot> step);
  void clear() { steps_.clear(); }
  /// Forgets that step and all after it.
  void drop_from(long step);

  bool empty() const { return steps_.empty(); }
  bool has(long step) const;
  /// One that it has.
  const Snapshot& at(long step) const;

 private:
  std::deque<std::shared_ptr<const Snapshot>> steps_;
};

}  // namespace pedicel::app
