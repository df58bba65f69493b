#pragma once

#include <string>
#include <vector>

#include "app/session/commands/command.h"

namespace pedicel::app {

/// Everything that was done since a document was opened, one line each: a script that does the same
/// again.
class CommandLog {
 public:
  const std::vector<std::string>& lines() const { return lines_; }
  void add(const std::string& line) { lines_.push_back(line); }
  /// A command of the run, from whatever folder the script is played. Of a dragged tool the last
  /// place counts.
  void add_run(const Command& command);
  /// As if they had not been done. Where something was undone since, that is said as one more undo.
  void forget(const std::vector<Command>& commands);
  void clear() { lines_.clear(); }

 private:
  std::vector<std::string> lines_;
};

}  // namespace pedicel::app
