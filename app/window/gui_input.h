#pragma once

#include <deque>
#include <vector>

#include "app/platform/platform.h"

namespace pedicel::app {

/// Whether a text is being typed.
bool types_text();

/// Hands input to Dear ImGui, which looks once a picture: what would be lost by that (a click that
/// is shorter than a picture, a move between press and release, a Ctrl that is let go right after
/// the key it was meant for) waits for the next one, in the order in which it happened.
class GuiInput {
 public:
  /// For the current ImGui context: names its keys and ties its clipboard to the platform's.
  explicit GuiInput(Platform& platform);

  /// Takes in what happened, gives ImGui as much as it can tell apart, and sets size and time step.
  /// Returns the files that were dropped.
  std::vector<std::string> begin_frame();
  /// Whether events wait for the next picture.
  bool has_more() const { return !waiting_.empty(); }

 private:
  bool hand_on(const InputEvent& event);
  bool has_to_wait(Key key) const;
  /// Whether a key only says a letter of a text.
  bool types(Key key) const;

  Platform& platform_;
  std::deque<InputEvent> waiting_;
  double last_time_ = 0.0;
  bool button_changed_ = false, moved_ = false, wheel_moved_ = false;
  std::vector<Key> keys_changed_;
};

}  // namespace pedicel::app
