#pragma once

#include <string>
#include <vector>

#include "app/platform/input.h"

namespace pedicel::app {

/// What a key, a button or a menu asks for.
enum class Action {
  none,
  play_pause,
  step,
  step_back,
  reset,
  reload,
  faster,
  slower,
  real_time,
  frame_selection,
  frame_all,
  previous_camera,
  next_camera,
  open,
  save,
  save_as,
  new_document,
  undo,
  redo,
  remove,
  duplicate,
  draw_mode,
  point_kind,
  insert_point,
  smooth,
  accept,
  select_child,
  select_parent,
  cancel,
  screenshot,
  video,
  panels,
  rods,
  contacts,
  frames,
  tool_handles,
  help,
  info,
  profiler,
  plots,
  full_screen,
  larger_text,
  smaller_text,
  quit,
};

struct Binding {
  Action action = Action::none;
  Key key = Key::none;
  bool control = false, shift = false;
  const char* group = "";     ///< heading in the help
  const char* sentence = "";  ///< the same in all bindings of an action
};

/// Every key that does something; the help and the tips of buttons come from it.
const std::vector<Binding>& bindings();

/// "Ctrl+Shift+S".
std::string key_text(const Binding& binding);
/// All keys of an action: "Ctrl+R, Ctrl+L"; empty where it has none.
std::string keys_of(Action action);
/// The sentence of an action; empty where it has no key.
std::string sentence_of(Action action);

/// What the mouse does in the scene, by preset, for the help.
struct MouseHabit {
  const char* gesture;
  const char* sentence;
};
std::vector<MouseHabit> mouse_habits(bool blender);

}  // namespace pedicel::app
