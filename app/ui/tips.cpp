#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string_view>

#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

constexpr double rest = 0.35;  // s that the pointer stands still before a tip comes

bool pointer_rests() {
  static ImVec2 at(-1, -1);
  static double since = 0.0;
  const ImVec2 now = ImGui::GetIO().MousePos;
  if (now.x != at.x || now.y != at.y || ImGui::GetTime() < since) {
    at = now;
    since = ImGui::GetTime();
  }
  return ImGui::GetTime() - since >= rest;
}

/// Beside the dock that it is of, over the scene: below the pointer it would cover what comes next.
ImVec2 place_for(const ImVec2& size) {
  const ImGuiWindow& dock = *ImGui::GetCurrentWindow()->RootWindow;
  const ImVec2 mouse = ImGui::GetIO().MousePos, screen = ImGui::GetIO().DisplaySize;
  const float gap = 0.4f * ImGui::GetFontSize();
  const std::string_view name = dock.Name;
  ImVec2 place(mouse.x + gap, mouse.y + 1.4f * ImGui::GetFontSize());
  if (name == "left") place = ImVec2(dock.Pos.x + dock.Size.x + gap, mouse.y);
  if (name == "right") place = ImVec2(dock.Pos.x - gap - size.x, mouse.y);
  if (name == "bottom" || name == "status") place = ImVec2(mouse.x, dock.Pos.y - gap - size.y);
  return ImVec2(std::clamp(place.x, 0.0f, std::max(0.0f, screen.x - size.x)),
                std::clamp(place.y, 0.0f, std::max(0.0f, screen.y - size.y)));
}

}  // namespace

void tip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (ImGui::GetIO().MouseDown[0] || !pointer_rests()) return;
  const float wide = 22.0f * ImGui::GetFontSize();
  const ImVec2 inside = ImGui::CalcTextSize(text.c_str(), nullptr, false, wide);
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  ImGui::SetNextWindowPos(place_for(ImVec2(inside.x + 2 * padding.x, inside.y + 2 * padding.y)));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wide + padding.x);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace pedicel::app
