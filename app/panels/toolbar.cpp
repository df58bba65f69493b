#include <algorithm>
#include <array>
#include <cstdio>

#include "app/editors/add_menu.h"
#include "app/panels/layout.h"
#include "app/session/session_files.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// A window with large letters: everything moves together.
bool is_narrow() {
  return ImGui::GetWindowWidth() < 46.0f * ImGui::GetFontSize();
}

void gap(const Ui& ui) {
  ImGui::SameLine(0, (is_narrow() ? 7.0f : 14.0f) * ui.scale);
}

void run_buttons(Ui& ui) {
  const RunMode mode = ui.snapshot->mode;
  const bool playing = mode == RunMode::playing, there = mode != RunMode::empty;
  action_button(ui, Action::reset, Icon::reset, there);
  ImGui::SameLine();
  action_button(ui, Action::step_back, Icon::step_back, there && ui.snapshot->step > 0);
  ImGui::SameLine();
  action_button(ui, Action::play_pause, playing ? Icon::pause : Icon::play,
                there && mode != RunMode::unstable, playing);
  ImGui::SameLine();
  action_button(ui, Action::step, Icon::step, there && mode != RunMode::unstable);
}

void speed_choice(Ui& ui) {
  constexpr std::array<double, 8> speeds = {0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 0.0};
  const auto text = [](double speed) -> std::string {
    return speed == 0.0 ? "as fast as it goes" : number_text(speed, 3) + " x";
  };
  ImGui::SetNextItemWidth((is_narrow() ? 3.8f : 5.2f) * ImGui::GetFontSize());
  const std::string now = ui.snapshot->speed == 0.0 ? std::string("max") : text(ui.snapshot->speed);
  if (ImGui::BeginCombo("##speed", now.c_str())) {
    for (const double speed : speeds)
      if (ImGui::Selectable(text(speed).c_str(), speed == ui.snapshot->speed))
        ui.session.control().set_speed(speed);
    ImGui::EndCombo();
  }
  tip("Simulated seconds a second (" + keys_of(Action::slower) + " and " + keys_of(Action::faster) +
      ")");
}

void add_button(Ui& ui) {
  if (ImGui::Button(is_narrow() ? "+" : "Add")) ImGui::OpenPopup("add to scene");
  tip("Adds a robot, a body, a camera, a plant to the scene");
  if (!ImGui::BeginPopup("add to scene")) return;
  draw_add_menu(ui);
  ImGui::EndPopup();
}

/// Draws a toggle for a part of the window.
void part_toggle(const char* label, bool& shown, const char* what) {
  if (shown) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
  const bool was = shown;
  if (ImGui::Button(label)) shown = !shown;
  if (was) ImGui::PopStyleColor();
  tip(what);
}

float width_of(const std::array<const char*, 3>& labels) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = 0.0f;
  for (const char* label : labels)
    width += ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
  return width;
}

std::string document_name(const Ui& ui) {
  std::string name = ui.session.files().path().filename().string();
  if (name.empty()) name = "new scene";
  return ui.session.files().dirty() ? name + " *" : name;
}

/// A dot on the last button: something was said behind it.
void unread_mark(const Ui& ui) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float radius = 4.0f * ui.scale;
  ImGui::GetWindowDrawList()->AddCircleFilled(ImVec2(high.x - radius, low.y + radius), radius,
                                              colour_u32(palette().warning));
}

}  // namespace

void draw_toolbar(Ui& ui) {
  action_button(ui, Action::open, Icon::open);
  ImGui::SameLine();
  action_button(ui, Action::save, Icon::save);
  ImGui::SameLine();
  action_button(ui, Action::reload, Icon::reload);
  gap(ui);
  action_button(ui, Action::undo, Icon::undo, ui.session.can_undo());
  ImGui::SameLine();
  action_button(ui, Action::redo, Icon::redo, ui.session.history().can_redo());
  gap(ui);
  run_buttons(ui);
  ImGui::SameLine();
  speed_choice(ui);
  gap(ui);
  add_button(ui);
  ImGui::SameLine();
  action_button(ui, Action::draw_mode, Icon::pencil, true, ui.draw.on);
  ImGui::SameLine();
  action_button(ui, Action::screenshot, Icon::camera);
  ImGui::SameLine();
  action_button(ui, Action::help, Icon::help);

  // To the right: what is open, and the parts of the window.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SameLine();
  std::array<const char*, 3> labels = {"Left", "Bottom", "Right"};
  const float most = ImGui::GetWindowWidth() - style.WindowPadding.x - ImGui::GetCursorPosX();
  if (width_of(labels) > most) labels = {"L", "B", "R"};
  const float start = std::max(ImGui::GetCursorPosX(),
                               ImGui::GetWindowWidth() - width_of(labels) - style.WindowPadding.x);
  const float room = start - ImGui::GetCursorPosX() - 2 * style.ItemSpacing.x;
  if (room > 4.0f * ImGui::GetFontSize()) {
    const std::string name = elide(document_name(ui), room);
    ImGui::SetCursorPosX(start - ImGui::CalcTextSize(name.c_str()).x - 2 * style.ItemSpacing.x);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(palette().dim, "%s", name.c_str());
    tip(ui.session.files().path().string());
    ImGui::SameLine();
  }
  ImGui::SetCursorPosX(start);
  part_toggle(labels[0], ui.preferences.show_left, "Plants and drawing");
  ImGui::SameLine();
  part_toggle(labels[1], ui.preferences.show_bottom, "Plots, events, messages, profiler");
  if (ui.unread && !ui.preferences.show_bottom) unread_mark(ui);
  ImGui::SameLine();
  part_toggle(labels[2], ui.preferences.show_right, "Tuning, robot, view, measured data");
}

}  // namespace pedicel::app
