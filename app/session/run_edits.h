#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/session/live/snapshot.h"

namespace pedicel::app {

/// What was done to the plants of a run by hand or by command: pulls and cuts. Undo takes them back
/// as it takes back edits of the document: whichever came last.
class RunEdits {
 public:
  struct Edit {
    std::string what;         ///< "pull", "cut"
    std::uint64_t stage = 0;  ///< of the simulation
    long step = 0;            ///< where it began
    std::size_t edits = 0;    ///< steps of the document's history then
    bool by_command = false;  ///< it is in the log
  };

  void add(const std::string& what, const Snapshot& now, std::size_t edits, bool by_command);
  /// Whether something is left of the last one, and no edit of the document came after it.
  bool has(const Snapshot& now, std::size_t edits) const;
  /// The last one, which is forgotten. There must be one.
  Edit take();

 private:
  std::vector<Edit> edits_;  // the last one at the end
};

}  // namespace pedicel::app
