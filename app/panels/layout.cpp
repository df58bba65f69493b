#include "app/panels/layout.h"

#include <algorithm>
#include <utility>

#include "app/panels/time_line.h"
#include "app/ui/theme.h"

namespace pedicel::app {

namespace {

constexpr float narrow_drawer = 28.0f;  // letters
constexpr float two_sidebars = 52.0f;   // letters of a window that has room for both

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus |
                                   ImGuiWindowFlags_NoSavedSettings;

bool begin_bar(const char* id, const ImVec2& low, const ImVec2& high, const ImVec2& padding) {
  ImGui::SetNextWindowPos(low);
  ImGui::SetNextWindowSize(ImVec2(high.x - low.x, high.y - low.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  const bool open = ImGui::Begin(
      id, nullptr, fixed | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar(3);
  return open;
}

}  // namespace

Layout::Layout() : panels_(make_panels()) {}

bool Layout::has(const Ui& ui, Dock where) const {
  return std::ranges::any_of(
      panels_, [&](const auto& panel) { return panel->dock() == where && panel->useful(ui); });
}

/// A line between a dock and the scene that can be dragged.
bool Layout::edge(const char* id, const ImVec2& low, const ImVec2& high, bool across, double& size,
                  double sign, double least, double most, float scale) {
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton(id,
                         ImVec2(std::max(high.x - low.x, 1.0f), std::max(high.y - low.y, 1.0f)));
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(across ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetForegroundDrawList()->AddRectFilled(low, high, colour_u32(palette().accent, 0.6f));
  }
  if (!ImGui::IsItemActive()) return false;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  size = std::clamp(size + sign * static_cast<double>(across ? moved.x : moved.y) / scale, least,
                    most);
  return true;
}

void Layout::dock(Ui& ui, Dock where, const char* id, const ImVec2& low, const ImVec2& high) {
  const float grip = 4.0f * ui.scale;
  if (begin_bar(id, low, high, ImVec2(0, 0))) {
    Preferences& p = ui.preferences;
    if (where == Dock::left)
      edge("edge", ImVec2(high.x - grip, low.y), high, true, p.left_width, 1, 180, 600, ui.scale);
    if (where == Dock::right)
      edge("edge", low, ImVec2(low.x + grip, high.y), true, p.right_width, -1, 200, 600, ui.scale);
    if (where == Dock::bottom)
      edge("edge", low, ImVec2(high.x, low.y + grip), false, p.bottom_height, -1, 100, 600,
           ui.scale);
    ImGui::SetCursorScreenPos(ImVec2(low.x + 8.0f * ui.scale, low.y + 6.0f * ui.scale));
    ImGui::BeginGroup();
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) {
      for (const auto& panel : panels_) {
        if (panel->dock() != where || !panel->useful(ui)) continue;
        const bool wanted = asked_ == panel->name();
        if (!ImGui::BeginTabItem(panel->name().data(), nullptr,
                                 wanted ? ImGuiTabItemFlags_SetSelected : 0)) {
          panel->idle(ui);
          continue;
        }
        ImGui::PushID(panel->name().data());
        const float right = 8.0f * ui.scale;
        if (ImGui::BeginChild("body", ImVec2(high.x - ImGui::GetCursorScreenPos().x - right,
                                             high.y - ImGui::GetCursorScreenPos().y - right)))
          panel->draw(ui);
        ImGui::EndChild();
        ImGui::PopID();
        ImGui::EndTabItem();
      }
      ImGui::EndTabBar();
    }
    ImGui::EndGroup();
  }
  ImGui::End();
}

/// In a window for one sidebar only the last one that was asked for stays, until it is wider.
void Layout::give_way(Ui& ui, float width) {
  Preferences& p = ui.preferences;
  for (const auto& panel : panels_)
    if (panel->name() == asked_ && panel->dock() != Dock::bottom) last_side_ = panel->dock();
  if (p.show_left && !had_left_) last_side_ = Dock::left;
  if (p.show_right && !had_right_) last_side_ = Dock::right;
  const bool narrow = width < two_sidebars * ImGui::GetFontSize();
  if (narrow && p.show_left && p.show_right) {
    gave_way_ = last_side_ == Dock::left ? Dock::right : Dock::left;
    (gave_way_ == Dock::left ? p.show_left : p.show_right) = false;
  }
  if (!narrow && gave_way_) (*gave_way_ == Dock::left ? p.show_left : p.show_right) = true;
  if (!narrow) gave_way_.reset();
  had_left_ = p.show_left, had_right_ = p.show_right;
}

LayoutAreas Layout::draw(Ui& ui) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  Preferences& p = ui.preferences;
  asked_ = std::exchange(ui.show_panel, {});
  for (const auto& panel : panels_) {
    if (panel->name() != asked_) continue;
    // What it is about may be on its way: a robot is built.
    if (!panel->useful(ui)) ui.show_panel = asked_;
    if (panel->dock() == Dock::left) p.show_left = true;
    if (panel->dock() == Dock::right) p.show_right = true;
    if (panel->dock() == Dock::bottom) p.show_bottom = true;
  }
  const float s = ui.scale;
  give_way(ui, size.x);
  const float top = ImGui::GetFrameHeight() + 12.0f * s;
  const float status = ImGui::GetTextLineHeight() + 10.0f * s;
  const ImVec2 padding(8.0f * s, 6.0f * s);
  // A sidebar alone may be wider: in a small window its tabs need that.
  const float most = p.show_left && p.show_right ? 0.4f : 0.46f;
  const auto part = [&](bool shown, Dock where, double points, float of) {
    return shown && has(ui, where) ? std::min(static_cast<float>(points) * s, most * of) : 0.0f;
  };
  const float left = part(p.show_left, Dock::left, p.left_width, size.x);
  const float right = part(p.show_right, Dock::right, p.right_width, size.x);
  const float bottom = part(p.show_bottom, Dock::bottom, p.bottom_height, size.y);

  if (begin_bar("toolbar", ImVec2(0, 0), ImVec2(size.x, top), padding)) draw_toolbar(ui);
  ImGui::End();
  if (begin_bar("status", ImVec2(0, size.y - status), size, ImVec2(10.0f * s, 5.0f * s)))
    draw_status_bar(ui);
  ImGui::End();
  const float low = top, high = size.y - status, above = high - bottom;
  // Between sidebars that leave too little room the drawer goes below them.
  const bool below = size.x - left - right < narrow_drawer * ImGui::GetFontSize();
  const float side = below ? above : high;
  if (left > 0) dock(ui, Dock::left, "left", ImVec2(0, low), ImVec2(left, side));
  if (right > 0) dock(ui, Dock::right, "right", ImVec2(size.x - right, low), ImVec2(size.x, side));
  const auto hidden = [&](Dock where) {
    return (where == Dock::left && left == 0) || (where == Dock::right && right == 0) ||
           (where == Dock::bottom && bottom == 0);
  };
  for (const auto& panel : panels_)
    if (hidden(panel->dock())) panel->idle(ui);
  if (bottom > 0)
    dock(ui, Dock::bottom, "bottom", ImVec2(below ? 0 : left, above),
         ImVec2(below ? size.x : size.x - right, high));
  const float line = time_line_height(ui), scene_end = above - line;
  if (line > 0.0f) {
    const ImVec2 from(left, scene_end), to(size.x - right, above);
    if (begin_bar("time line", from, to, ImVec2(0, 0))) draw_time_line(ui, from, to);
    ImGui::End();
  }
  return {ImVec2(left, low), ImVec2(size.x - right, scene_end)};
}

}  // namespace pedicel::app
