#include <cmath>

#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// Signs are drawn in a square from -1 to 1.
struct Pen {
  ImDrawList& list;
  ImVec2 centre;
  float half;
  ImU32 colour;

  ImVec2 at(float x, float y) const { return {centre.x + half * x, centre.y + half * y}; }
  float width() const { return std::max(1.5f, 0.22f * half); }
  void triangle(float x0, float y0, float x1, float y1, float x2, float y2) const {
    list.AddTriangleFilled(at(x0, y0), at(x1, y1), at(x2, y2), colour);
  }
  void box(float x0, float y0, float x1, float y1) const {
    list.AddRectFilled(at(x0, y0), at(x1, y1), colour);
  }
  void frame(float x0, float y0, float x1, float y1) const {
    list.AddRect(at(x0, y0), at(x1, y1), colour, 0.15f * half, 0, width());
  }
  void line(float x0, float y0, float x1, float y1) const {
    list.AddLine(at(x0, y0), at(x1, y1), colour, width());
  }
  /// Part of a circle, rad clockwise from the right.
  void arc(float radius, float from, float to) const {
    list.PathArcTo(centre, radius * half, from, to, 20);
    list.PathStroke(colour, 0, width());
  }
};

constexpr float pi = 3.14159265f;

void turn_back(const Pen& p, bool mirrored) {
  const float s = mirrored ? -1.0f : 1.0f;
  p.list.PathLineTo(p.at(-0.75f * s, -0.2f));
  p.list.PathBezierCubicCurveTo(p.at(0.5f * s, -0.75f), p.at(1.1f * s, 0.3f),
                                p.at(0.1f * s, 0.75f));
  p.list.PathStroke(p.colour, 0, p.width());
  p.triangle(-0.95f * s, -0.15f, -0.2f * s, -0.75f, -0.15f * s, 0.2f);
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, const ImVec2& centre, float size, ImU32 colour) {
  const Pen p{list, centre, 0.5f * size, colour};
  switch (icon) {
    case Icon::play:
      p.triangle(-0.6f, -0.85f, 0.9f, 0, -0.6f, 0.85f);
      break;
    case Icon::pause:
      p.box(-0.65f, -0.8f, -0.15f, 0.8f), p.box(0.15f, -0.8f, 0.65f, 0.8f);
      break;
    case Icon::step:
      p.triangle(-0.75f, -0.75f, 0.4f, 0, -0.75f, 0.75f), p.box(0.45f, -0.75f, 0.75f, 0.75f);
      break;
    case Icon::step_back:
      p.triangle(0.75f, -0.75f, -0.4f, 0, 0.75f, 0.75f), p.box(-0.75f, -0.75f, -0.45f, 0.75f);
      break;
    case Icon::reset:
      p.triangle(0.9f, -0.7f, 0.05f, 0, 0.9f, 0.7f), p.triangle(0.1f, -0.7f, -0.75f, 0, 0.1f, 0.7f);
      p.box(-0.95f, -0.7f, -0.72f, 0.7f);
      break;
    case Icon::reload:
      p.arc(0.72f, -0.3f * pi, 1.35f * pi), p.triangle(0.15f, -1.0f, 0.95f, -0.75f, 0.3f, -0.15f);
      break;
    case Icon::open:
      p.line(-0.85f, 0.65f, -0.85f, -0.6f), p.line(-0.85f, -0.6f, -0.3f, -0.6f);
      p.line(-0.3f, -0.6f, -0.05f, -0.3f), p.line(-0.05f, -0.3f, 0.65f, -0.3f);
      p.line(0.65f, -0.3f, 0.65f, 0.0f), p.line(-0.85f, 0.65f, -0.45f, 0.0f);
      p.line(-0.45f, 0.0f, 0.95f, 0.0f), p.line(0.95f, 0.0f, 0.6f, 0.65f);
      p.line(0.6f, 0.65f, -0.85f, 0.65f);
      break;
    case Icon::save:
      p.line(0, -0.85f, 0, 0.1f), p.triangle(-0.45f, -0.1f, 0.45f, -0.1f, 0, 0.45f);
      p.line(-0.8f, 0.25f, -0.8f, 0.8f), p.line(-0.8f, 0.8f, 0.8f, 0.8f);
      p.line(0.8f, 0.8f, 0.8f, 0.25f);
      break;
    case Icon::undo:
      turn_back(p, false);
      break;
    case Icon::redo:
      turn_back(p, true);
      break;
    case Icon::pencil:
      list.AddLine(p.at(-0.45f, 0.45f), p.at(0.65f, -0.65f), colour, 2.0f * p.width());
      p.triangle(-0.85f, 0.85f, -0.65f, 0.2f, -0.2f, 0.65f);
      break;
    case Icon::camera:
      p.frame(-0.85f, -0.45f, 0.85f, 0.7f), p.box(-0.3f, -0.7f, 0.3f, -0.45f),
          p.arc(0.34f, 0, 2 * pi);
      break;
    case Icon::help: {
      const float height = 1.05f * size;
      const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(height, 1e9f, 0, "?");
      list.AddText(ImGui::GetFont(), height,
                   ImVec2(centre.x - 0.5f * extent.x, centre.y - 0.5f * extent.y), colour, "?");
      break;
    }
    case Icon::cross:
      p.line(-0.6f, -0.6f, 0.6f, 0.6f), p.line(-0.6f, 0.6f, 0.6f, -0.6f);
      break;
    case Icon::warning:
      list.AddTriangle(p.at(0, -0.85f), p.at(0.9f, 0.75f), p.at(-0.9f, 0.75f), colour, p.width());
      p.line(0, -0.3f, 0, 0.25f), p.box(-0.1f, 0.42f, 0.1f, 0.6f);
      break;
  }
}

bool icon_button(const char* id, Icon icon, const std::string& text, bool enabled, bool active) {
  const float side = ImGui::GetFrameHeight();
  ImGui::PushID(id);
  ImGui::BeginDisabled(!enabled);
  if (active) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
  const bool pressed = ImGui::Button("##icon", ImVec2(1.25f * side, side));
  if (active) ImGui::PopStyleColor();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  draw_icon(*ImGui::GetWindowDrawList(), icon,
            ImVec2(0.5f * (low.x + high.x), 0.5f * (low.y + high.y)), 0.52f * side,
            colour_u32(active ? palette().good : palette().text, enabled ? 1.0f : 0.35f));
  ImGui::EndDisabled();
  ImGui::PopID();
  tip(text);
  return pressed;
}

bool action_button(Ui& ui, Action action, Icon icon, bool enabled, bool active) {
  const std::string keys = keys_of(action);
  const std::string text = sentence_of(action) + (keys.empty() ? "" : " (" + keys + ")");
  const bool pressed = icon_button(sentence_of(action).c_str(), icon, text, enabled, active);
  if (pressed) ui.ask(action);
  return pressed;
}

}  // namespace pedicel::app
