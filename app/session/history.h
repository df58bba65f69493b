#pragma once

#include <string>
#include <vector>

#include "app/session/commands/command.h"
#include "app/session/document/document.h"

namespace pedicel::app {

/// Past and future of a document. A step of it is what one gesture did: a stroke, a drag, a command
/// on its own.
class History {
 public:
  struct Step {
    std::vector<Command> commands;
    Document before, after;
  };

  void add(Step step);
  /// Forgets everything (another document).
  void clear();
  bool can_undo() const { return position_ > 0; }
  bool can_redo() const { return position_ < steps_.size(); }
  /// "move point"; empty where there is nothing.
  std::string undo_name() const;
  std::string redo_name() const;
  /// The document before the last step, or after the next one. There must be one.
  const Document& undo();
  const Document& redo();
  /// The document before the last step, which is forgotten with those that were undone. There must
  /// be one.
  Document drop();
  const Step& last() const { return steps_[position_ - 1]; }
  /// Steps that count, the oldest first.
  std::vector<Step> past() const {
    return {steps_.begin(), steps_.begin() + static_cast<long>(position_)};
  }
  std::size_t size() const { return position_; }

 private:
  std::vector<Step> steps_;
  std::size_t position_ = 0;
};

}  // namespace pedicel::app
