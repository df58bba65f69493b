#include "app/ui/bindings.h"

#include <map>

namespace pedicel::app {

const std::vector<Binding>& bindings() {
  static const std::vector<Binding> table = {
      {Action::play_pause, Key::space, false, false, "Simulation", "Play or pause"},
      {Action::step, Key::right, false, false, "Simulation", "One step forward"},
      {Action::step, Key::period, false, false, "Simulation", "One step forward"},
      {Action::step_back, Key::left, false, false, "Simulation", "One step back"},
      {Action::reset, Key::backspace, false, false, "Simulation", "Back to time 0, edits stay"},
      {Action::reload, Key::r, true, false, "Simulation", "Read the files anew, camera stays"},
      {Action::reload, Key::l, true, false, "Simulation", "Read the files anew, camera stays"},
      {Action::faster, Key::equal, false, true, "Simulation", "Faster"},
      {Action::faster, Key::pad_add, false, false, "Simulation", "Faster"},
      {Action::slower, Key::minus, false, false, "Simulation", "Slower"},
      {Action::slower, Key::pad_subtract, false, false, "Simulation", "Slower"},

      {Action::open, Key::o, true, false, "File", "Open a scene, plant, table or experiment"},
      {Action::save, Key::s, true, false, "File", "Save"},
      {Action::save_as, Key::s, true, true, "File", "Save under another name"},
      {Action::new_document, Key::n, true, false, "File", "New, empty scene"},
      {Action::screenshot, Key::p, true, false, "File", "Picture of the window"},
      {Action::screenshot, Key::f12, false, false, "File", "Picture of the window"},
      {Action::video, Key::p, true, true, "File", "Start or end a film"},
      {Action::quit, Key::q, true, false, "File", "Quit"},

      {Action::undo, Key::z, true, false, "Edit", "Undo"},
      {Action::redo, Key::z, true, true, "Edit", "Redo"},
      {Action::redo, Key::y, true, false, "Edit", "Redo"},
      {Action::remove, Key::del, false, false, "Edit", "Remove what is selected"},
      {Action::duplicate, Key::d, true, false, "Edit", "Duplicate the chosen plant, body, camera"},
      {Action::draw_mode, Key::d, false, false, "Edit", "Draw stems, on or off"},
      {Action::point_kind, Key::v, false, false, "Edit", "Point: smooth, corner, linear"},
      {Action::insert_point, Key::insert, false, false, "Edit", "Insert a point behind the chosen"},
      {Action::smooth, Key::s, false, false, "Edit", "Smooth the chosen point or stem"},
      {Action::accept, Key::enter, false, false, "Edit", "Accept"},
      {Action::select_child, Key::up, false, false, "Edit",
       "Select the child; in a stroke: thicker"},
      {Action::select_parent, Key::down, false, false, "Edit",
       "Select the parent; in a stroke: thinner"},
      {Action::cancel, Key::escape, false, false, "Edit", "Cancel, leave the mode, deselect"},

      {Action::frame_selection, Key::f, false, false, "View", "Frame what is selected"},
      {Action::frame_all, Key::home, false, false, "View", "Frame everything"},
      {Action::previous_camera, Key::left_bracket, false, false, "View", "Previous camera"},
      {Action::next_camera, Key::right_bracket, false, false, "View", "Next camera"},
      {Action::panels, Key::tab, false, false, "View", "Panels on or off"},
      {Action::rods, Key::w, false, false, "View", "Rods and their nodes as lines"},
      {Action::contacts, Key::c, false, false, "View", "Contact forces"},
      {Action::frames, Key::j, false, false, "View", "Frames of links and tool"},
      {Action::tool_handles, Key::g, false, false, "View", "Handles of the robot's tool"},
      {Action::full_screen, Key::f11, false, false, "View", "Full screen"},
      {Action::larger_text, Key::equal, true, false, "View", "Larger text"},
      {Action::smaller_text, Key::minus, true, false, "View", "Smaller text"},

      {Action::help, Key::f1, false, false, "Windows", "This help"},
      {Action::info, Key::f2, false, false, "Windows", "About the scene and the program"},
      {Action::profiler, Key::f3, false, false, "Windows", "Profiler"},
      {Action::plots, Key::f4, false, false, "Windows", "Plots"},
  };
  return table;
}

std::string key_text(const Binding& binding) {
  static const std::map<Key, std::string> names = {{Key::space, "Space"},
                                                   {Key::right, "Right"},
                                                   {Key::left, "Left"},
                                                   {Key::up, "Up"},
                                                   {Key::down, "Down"},
                                                   {Key::period, "."},
                                                   {Key::backspace, "Backspace"},
                                                   {Key::equal, "="},
                                                   {Key::minus, "-"},
                                                   {Key::pad_add, "Pad +"},
                                                   {Key::pad_subtract, "Pad -"},
                                                   {Key::del, "Del"},
                                                   {Key::insert, "Ins"},
                                                   {Key::enter, "Enter"},
                                                   {Key::escape, "Esc"},
                                                   {Key::home, "Home"},
                                                   {Key::left_bracket, "["},
                                                   {Key::right_bracket, "]"},
                                                   {Key::tab, "Tab"},
                                                   {Key::f1, "F1"},
                                                   {Key::f2, "F2"},
                                                   {Key::f3, "F3"},
                                                   {Key::f4, "F4"},
                                                   {Key::f11, "F11"},
                                                   {Key::f12, "F12"}};
  if (binding.key == Key::equal && binding.shift && !binding.control) return "+";
  std::string text = binding.control ? "Ctrl+" : "";
  if (binding.shift) text += "Shift+";
  const auto name = names.find(binding.key);
  return text +
         (name != names.end() ? name->second : std::string(1, static_cast<char>(binding.key)));
}

std::string keys_of(Action action) {
  std::string text;
  for (const Binding& binding : bindings())
    if (binding.action == action) text += (text.empty() ? "" : ", ") + key_text(binding);
  return text;
}

std::string sentence_of(Action action) {
  for (const Binding& binding : bindings())
    if (binding.action == action) return binding.sentence;
  return "";
}

std::vector<MouseHabit> mouse_habits(bool blender) {
  std::vector<MouseHabit> habits;
  if (blender)
    habits = {{"Middle drag", "Turn the view"},
              {"Shift+middle drag", "Move the view"},
              {"Ctrl+middle drag, wheel", "Nearer, farther"}};
  else
    habits = {{"Left drag", "Turn the view"},
              {"Right or middle drag, Shift+left drag", "Move the view"},
              {"Wheel, Ctrl+Shift+left drag", "Nearer, farther"}};
  habits.insert(habits.end(),
                {{"Click", "Select"},
                 {"Double click", "Select, and turn about that place; on nothing: deselect"},
                 {"Ctrl+left drag", "Pull a plant with a spring"},
                 {"Ctrl+right drag", "Push it along the view"},
                 {"Drag of a handle", "Move or turn the robot's tool"},
                 {"Alt+click", "Select from here to the tip; Del cuts it off"},
                 {"Wheel in a stroke", "Thicker, thinner from here on"}});
  return habits;
}

}  // namespace pedicel::app
