#include "app/window/gui_input.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <limits>

namespace pedicel::app {

namespace {

void name_keys(ImGuiIO& io) {
  constexpr std::pair<ImGuiKey_, Key> names[] = {{ImGuiKey_Tab, Key::tab},
                                                 {ImGuiKey_LeftArrow, Key::left},
                                                 {ImGuiKey_RightArrow, Key::right},
                                                 {ImGuiKey_UpArrow, Key::up},
                                                 {ImGuiKey_DownArrow, Key::down},
                                                 {ImGuiKey_PageUp, Key::page_up},
                                                 {ImGuiKey_PageDown, Key::page_down},
                                                 {ImGuiKey_Home, Key::home},
                                                 {ImGuiKey_End, Key::end},
                                                 {ImGuiKey_Insert, Key::insert},
                                                 {ImGuiKey_Delete, Key::del},
                                                 {ImGuiKey_Backspace, Key::backspace},
                                                 {ImGuiKey_Space, Key::space},
                                                 {ImGuiKey_Enter, Key::enter},
                                                 {ImGuiKey_Escape, Key::escape},
                                                 {ImGuiKey_KeyPadEnter, Key::pad_enter},
                                                 {ImGuiKey_A, Key::a},
                                                 {ImGuiKey_C, Key::c},
                                                 {ImGuiKey_V, Key::v},
                                                 {ImGuiKey_X, Key::x},
                                                 {ImGuiKey_Y, Key::y},
                                                 {ImGuiKey_Z, Key::z}};
  for (const auto& [theirs, ours] : names) io.KeyMap[theirs] = static_cast<int>(ours);
}

bool is_modifier(Key key) {
  return key >= Key::left_shift && key <= Key::right_super;
}

/// A key that stands for a letter, and is down for no more than that.
bool is_letter(Key key) {
  return key < Key::escape;
}

bool down(const ImGuiIO& io, Key a, Key b) {
  return io.KeysDown[static_cast<int>(a)] || io.KeysDown[static_cast<int>(b)];
}

}  // namespace

// io.WantTextInput comes a picture late: the key after Enter would be lost.
bool types_text() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return context.ActiveId != 0 && context.ActiveId == context.InputTextState.ID;
}

GuiInput::GuiInput(Platform& platform) : platform_(platform) {
  ImGuiIO& io = ImGui::GetIO();
  name_keys(io);
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasMouseCursors;
  io.ClipboardUserData = &platform_;
  io.SetClipboardTextFn = [](void* data, const char* text) {
    static_cast<Platform*>(data)->set_clipboard(text);
  };
  io.GetClipboardTextFn = [](void* data) {
    static std::string text;
    text = static_cast<Platform*>(data)->clipboard();
    return text.c_str();
  };
  last_time_ = platform_.now() - 1.0 / 60.0;
}

std::vector<std::string> GuiInput::begin_frame() {
  ImGuiIO& io = ImGui::GetIO();
  const double now = platform_.now();
  io.DeltaTime = static_cast<float>(std::clamp(now - last_time_, 1e-4, 0.5));
  last_time_ = now;
  const auto [width, height] = platform_.size();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));

  for (InputEvent& event : platform_.poll()) waiting_.push_back(std::move(event));
  button_changed_ = moved_ = wheel_moved_ = false;
  keys_changed_.clear();
  std::vector<std::string> dropped;
  while (!waiting_.empty() && hand_on(waiting_.front())) {
    if (waiting_.front().kind == InputEvent::Kind::drop) dropped.push_back(waiting_.front().text);
    waiting_.pop_front();
  }
  io.KeyCtrl = down(io, Key::left_control, Key::right_control) ||
               down(io, Key::left_super, Key::right_super);
  io.KeyShift = down(io, Key::left_shift, Key::right_shift);
  io.KeyAlt = down(io, Key::left_alt, Key::right_alt);
  return dropped;
}

/// Whether a key that changes now would change what others of this picture meant. Shift, Ctrl and
/// the like count as they stand when the picture is made: they wait once another key or the wheel
/// was taken. What is pressed or released after them goes with them.
bool GuiInput::has_to_wait(Key key) const {
  const bool again = std::ranges::count(keys_changed_, key) > 0;
  const bool others = std::ranges::any_of(keys_changed_, [](Key one) { return !is_modifier(one); });
  return button_changed_ || again || (is_modifier(key) && (others || wheel_moved_));
}

bool GuiInput::types(Key key) const {
  const ImGuiIO& io = ImGui::GetIO();
  return types_text() && is_letter(key) && !down(io, Key::left_control, Key::right_control) &&
         !down(io, Key::left_super, Key::right_super) && !down(io, Key::left_alt, Key::right_alt);
}

/// False where the event has to wait for the next picture.
bool GuiInput::hand_on(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::move:
      if (button_changed_) return false;
      io.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
      moved_ = true;
      return true;
    case InputEvent::Kind::leave:
      return true;  // a drag may go on outside
    case InputEvent::Kind::button:
      // One picture to hover, one to press: widgets want to have seen the pointer before.
      if (button_changed_ || moved_ || !keys_changed_.empty()) return false;
      io.MouseDown[event.button] = event.down;
      button_changed_ = true;
      return true;
    case InputEvent::Kind::wheel:
      if (button_changed_) return false;
      io.MouseWheel += static_cast<float>(event.y);
      wheel_moved_ = true;
      return true;
    case InputEvent::Kind::key:
      // While a text is typed, letters come as text: their keys need no picture each. After Enter
      // or a click the text may have ended.
      if (types(event.key)) {
        if (button_changed_ || !std::ranges::all_of(keys_changed_, is_modifier)) return false;
        io.KeysDown[static_cast<int>(event.key)] = event.down;
        return true;
      }
      if (has_to_wait(event.key)) return false;
      io.KeysDown[static_cast<int>(event.key)] = event.down;
      keys_changed_.push_back(event.key);
      return true;
    case InputEvent::Kind::text:
      if (button_changed_) return false;
      io.AddInputCharactersUTF8(event.text.c_str());
      return true;
    case InputEvent::Kind::drop:
      return true;
  }
  return true;
}

}  // namespace pedicel::app
