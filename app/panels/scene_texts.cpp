#include <array>
#include <cmath>
#include <cstdio>

#include "app/panels/layout.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "engine/render/colormap.h"

namespace pedicel::app {

namespace {

/// Text on a rounded, half transparent ground. Returns its size.
ImVec2 plate(ImDrawList& list, ImVec2 at, const std::string& text, float scale, ImU32 ground,
             ImU32 ink) {
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  const ImVec2 pad(9.0f * scale, 5.0f * scale);
  const ImVec2 high(at.x + extent.x + 2 * pad.x, at.y + extent.y + 2 * pad.y);
  list.AddRectFilled(at, high, ground, 5.0f * scale);
  list.AddText(ImVec2(at.x + pad.x, at.y + pad.y), ink, text.c_str());
  return {high.x - at.x, high.y - at.y};
}

constexpr ImU32 dark_ground = IM_COL32(18, 22, 26, 200), white = IM_COL32(240, 243, 245, 255);

void banner(Ui& ui, ImDrawList& list, const LayoutAreas& areas, const std::string& text,
            ImU32 ground) {
  const float width = ImGui::CalcTextSize(text.c_str()).x + 18.0f * ui.scale;
  const float middle = 0.5f * (areas.scene_min.x + areas.scene_max.x);
  plate(list,
        ImVec2(std::max(areas.scene_min.x + 4.0f, middle - 0.5f * width),
               areas.scene_min.y + 10.0f * ui.scale),
        text, ui.scale, ground, white);
}

void legend(Ui& ui, ImDrawList& list, const LayoutAreas& areas) {
  const ViewState& view = ui.view;
  if (view.colours == ColourMap::none) return;
  // The shape that a model says of the only plant has no strains: only residuals colour it.
  if (view.colours != ColourMap::residual && view.hidden_plant >= 0 &&
      ui.snapshot->plants.size() == 1)
    return;
  std::string title = "surface strain, 1", top = number_text(view.strain_scale, 3);
  if (view.colours == ColourMap::margin) title = "used of the threshold, %", top = "100";
  if (view.colours == ColourMap::contact)
    title = "contact force, N", top = number_text(view.contact_scale, 3);
  if (view.colours == ColourMap::residual) {
    if (!(view.measured.residual_scale > 0.0)) return;
    title = "residual of markers, mm", top = number_text(1e3 * view.measured.residual_scale, 3);
  }
  const float s = ui.scale, line = ImGui::GetTextLineHeight();
  const float width = std::max(ImGui::CalcTextSize(title.c_str()).x, 130.0f * s) + 20.0f * s;
  const ImVec2 low(areas.scene_max.x - width - 12.0f * s, areas.scene_max.y - 2 * line - 46.0f * s);
  const ImVec2 high(areas.scene_max.x - 12.0f * s, areas.scene_max.y - 12.0f * s);
  list.AddRectFilled(low, high, dark_ground, 5.0f * s);
  list.AddText(ImVec2(low.x + 10.0f * s, low.y + 6.0f * s), white, title.c_str());
  const float bar_low = low.y + line + 10.0f * s, bar_high = bar_low + 10.0f * s;
  const float left = low.x + 10.0f * s, right = high.x - 10.0f * s;
  constexpr int parts = 48;
  for (int i = 0; i < parts; ++i) {
    const render::Colour c = render::strain_colour((i + 0.5) / parts);
    const auto at = [&](int k) { return left + (right - left) * static_cast<float>(k) / parts; };
    list.AddRectFilled(ImVec2(at(i), bar_low), ImVec2(at(i + 1), bar_high),
                       ImGui::ColorConvertFloat4ToU32(ImVec4(c.r, c.g, c.b, 1.0f)));
  }
  list.AddText(ImVec2(left, bar_high + 3.0f * s), white, "0");
  list.AddText(ImVec2(right - ImGui::CalcTextSize(top.c_str()).x, bar_high + 3.0f * s), white,
               top.c_str());
}

void hint(Ui& ui, const LayoutAreas& areas) {
  if (ui.preferences.seen_hint || ui.draw.on) return;
  const float s = ui.scale, side = 14.0f * s;
  const float width = std::min(620.0f * s, areas.scene_max.x - areas.scene_min.x - 2 * side);
  const float middle = 0.5f * (areas.scene_min.x + areas.scene_max.x);
  ImGui::SetNextWindowPos(ImVec2(middle - 0.5f * width, areas.scene_max.y - side), ImGuiCond_Always,
                          ImVec2(0, 1));
  ImGui::SetNextWindowSize(ImVec2(width, 0));
  ImGui::SetNextWindowBgAlpha(0.92f);
  if (ImGui::Begin("hint", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing)) {
    const float button = ImGui::CalcTextSize("Got it").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::PushTextWrapPos(ImGui::GetContentRegionMax().x - button - 12.0f * s);
    ImGui::TextUnformatted(
        "Press Space to play. Hold Ctrl and drag a fruit or a stem to pull it, or press D and draw "
        "a new branch. Drag to turn the view; F1 shows everything else.");
    ImGui::PopTextWrapPos();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
    if (ImGui::Button("Got it")) ui.preferences.seen_hint = true;
  }
  ImGui::End();
}

/// Broken at blanks into lines of that width, three at most.
std::string lines_in(const std::string& text, float width) {
  constexpr int most = 3;
  std::string all, rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    std::size_t end = std::min(rest.find('\n'), rest.size());
    while (end > 0 && ImGui::CalcTextSize(rest.substr(0, end).c_str()).x > width) {
      const std::size_t blank = rest.rfind(' ', end - 1);
      end = blank == std::string::npos ? 0 : blank;
    }
    if (end == 0 || (line == most && end < rest.size()))
      return all + elide(rest.substr(0, rest.find('\n')), width);
    all += rest.substr(0, end) + "\n";
    rest.erase(0, std::min(end + 1, rest.size()));
  }
  if (!all.empty()) all.pop_back();
  return all;
}

void notice(Ui& ui, ImDrawList& list, const LayoutAreas& areas) {
  constexpr double shown = 6.0;  // s
  if (ui.notice.empty() || ui.now - ui.notice_time > shown) return;
  const float room = areas.scene_max.x - areas.scene_min.x - 50.0f * ui.scale;
  plate(list, ImVec2(areas.scene_min.x + 12.0f * ui.scale, areas.scene_min.y + 44.0f * ui.scale),
        lines_in(ui.notice, room), ui.scale, dark_ground, white);
}

/// Long builds are those of a robot's distance grids.
std::string building_text(const Ui& ui) {
  constexpr double soon = 0.7, long_since = 5.0;  // s
  const double since = ui.session.control().building_for();
  if (since < soon) return ui.snapshot->mode == RunMode::building ? "Building the scene ..." : "";
  std::string text = "Building the scene: " + std::to_string(static_cast<int>(since)) + " s";
  if (since > long_since) text += " (distance grids of meshes are made once and kept)";
  return text;
}

/// What the arrows' lengths are.
void contact_scale(Ui& ui, ImDrawList& list, const LayoutAreas& areas) {
  if (!ui.view.contacts) return;
  const std::string text = "contact arrows: 30 mm is 1 N, 60 mm 4 N, 95 mm 10 N";
  const float tall = ImGui::GetTextLineHeight() + 10.0f * ui.scale;
  const float room = areas.scene_max.x - areas.scene_min.x - 40.0f * ui.scale;
  plate(list,
        ImVec2(areas.scene_min.x + 12.0f * ui.scale, areas.scene_max.y - tall - 12.0f * ui.scale),
        elide(text, room), ui.scale, dark_ground, white);
}

}  // namespace

void draw_scene_texts(Ui& ui, const LayoutAreas& areas) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  ImDrawList& over = *ImGui::GetForegroundDrawList();
  (void)list;
  const Snapshot& s = *ui.snapshot;
  if (ui.dialog != Dialog::none) return;  // they would lie over it
  if (s.mode == RunMode::unstable)
    banner(ui, over, areas,
           "Unstable: " + (s.culprit.empty() ? s.error : s.culprit) + ", last good at " +
               number_text(s.last_good_time, 4) + " s. Step back or reset.",
           IM_COL32(170, 40, 34, 235));
  else if (ui.draw.on && ui.draw.thing == DrawThing::trim)
    banner(ui, over, areas, "Cutting: draw across stems or click on one, Esc leaves",
           IM_COL32(150, 44, 36, 235));
  else if (ui.draw.on && ui.draw.thing == DrawThing::tie)
    banner(ui, over, areas, "Tying: drag from a stem to where the string ends, Esc leaves",
           IM_COL32(62, 120, 34, 235));
  else if (ui.draw.on)
    banner(ui, over, areas, "Drawing: left draws, Alt+left turns the view, Esc leaves",
           IM_COL32(62, 120, 34, 235));
  else if (const std::string building = building_text(ui); !building.empty())
    banner(ui, over, areas, building, dark_ground);
  if (ui.recording)
    over.AddCircleFilled(
        ImVec2(areas.scene_max.x - 20.0f * ui.scale, areas.scene_min.y + 20.0f * ui.scale),
        6.0f * ui.scale, IM_COL32(224, 50, 45, 255));
  legend(ui, over, areas);
  contact_scale(ui, over, areas);
  notice(ui, over, areas);
  hint(ui, areas);
}

}  // namespace pedicel::app
