#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pedicel/app/session/live/snapshot.h"

namespace pedicel::app {

/// Pulls, which undo takes back as it takes back edits: whichever came last.
class PullHistory {
 public:
  struct Pull {
    std::uint64_t stage = 0;  ///< of the simulation
    long step = 0;            ///< where it began
    std::size_t edits = 0;    ///< steps of the document's history then
    bool by_command = false;  ///< it is in the log
  };

  /// A pull begins.
  void add(const Snapshot& now, std::size_t edits, bool by_command);
  /// Whether something is left of the last one, and no edit came after it.
  bool has(const Snapshot& now, std::size_t edits) const;
  /// The last one, which is forgotten. There must be one.
  Pull take();

 private:
  std::vector<Pull> pulls_;  // the last one at the end
};

}  // namespace pedicel::app
