#include "app/ui/theme.h"

#include <cstdint>

namespace pedicel::app {

namespace {

ImVec4 rgb(std::uint32_t hex, float alpha = 1.0f) {
  return {static_cast<float>((hex >> 16) & 255u) / 255.0f,
          static_cast<float>((hex >> 8) & 255u) / 255.0f, static_cast<float>(hex & 255u) / 255.0f,
          alpha};
}

ImVec4 faded(const ImVec4& colour, float alpha) {
  return {colour.x, colour.y, colour.z, alpha};
}

Palette dark() {
  return {rgb(0xe6e9ec), rgb(0x9aa3ab), rgb(0x6fae45), rgb(0x7cc25a), rgb(0xe8a53d),
          rgb(0xf06a5d), rgb(0x16191c), rgb(0x1f2327), rgb(0x2d3338), rgb(0x3a4147)};
}

Palette light() {
  return {rgb(0x20262b), rgb(0x5f6971), rgb(0x4b8a2b), rgb(0x3b8a2a), rgb(0xb06a00),
          rgb(0xc23325), rgb(0xe3e6e8), rgb(0xf4f5f6), rgb(0xffffff), rgb(0xc6ccd1)};
}

Palette& current() {
  static Palette palette = dark();
  return palette;
}

void set_sizes(ImGuiStyle& style) {
  style.WindowPadding = ImVec2(10, 8);
  style.FramePadding = ImVec2(8, 4);
  style.CellPadding = ImVec2(5, 3);
  style.ItemSpacing = ImVec2(8, 6);
  style.ItemInnerSpacing = ImVec2(6, 4);
  style.IndentSpacing = 16;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 9;
  style.WindowRounding = 6;
  style.ChildRounding = 5;
  style.FrameRounding = 4;
  style.PopupRounding = 5;
  style.GrabRounding = 3;
  style.TabRounding = 4;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
}

void set_colours(ImGuiStyle& style, const Palette& p, bool is_light) {
  ImVec4* c = style.Colors;
  const ImVec4 field = is_light ? rgb(0xe6eaed) : rgb(0x2a3036);
  const ImVec4 hovered = is_light ? rgb(0xd8dfe4) : rgb(0x353d44);
  const ImVec4 pressed = is_light ? rgb(0xc9d3da) : rgb(0x414b53);
  c[ImGuiCol_Text] = p.text;
  c[ImGuiCol_TextDisabled] = p.dim;
  c[ImGuiCol_WindowBg] = p.panel;
  c[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_PopupBg] = is_light ? rgb(0xfbfcfc) : rgb(0x262b30);
  c[ImGuiCol_Border] = p.line;
  c[ImGuiCol_BorderShadow] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_FrameBg] = field;
  c[ImGuiCol_FrameBgHovered] = hovered;
  c[ImGuiCol_FrameBgActive] = pressed;
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = p.panel;
  c[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_ScrollbarGrab] = pressed;
  c[ImGuiCol_ScrollbarGrabHovered] = c[ImGuiCol_ScrollbarGrabActive] = p.dim;
  c[ImGuiCol_CheckMark] = p.accent;
  // The number of a slider is written over its grab: a ground that its letters can be read on.
  c[ImGuiCol_SliderGrab] = is_light ? rgb(0xa5cc8c) : rgb(0x3f6a28);
  c[ImGuiCol_SliderGrabActive] = is_light ? rgb(0x94c077) : rgb(0x44712d);
  c[ImGuiCol_Button] = field;
  c[ImGuiCol_ButtonHovered] = hovered;
  c[ImGuiCol_ButtonActive] = pressed;
  c[ImGuiCol_Header] = faded(p.accent, is_light ? 0.25f : 0.30f);
  c[ImGuiCol_HeaderHovered] = faded(p.accent, 0.20f);
  c[ImGuiCol_HeaderActive] = faded(p.accent, 0.40f);
  c[ImGuiCol_Separator] = p.line;
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = p.accent;
  c[ImGuiCol_ResizeGrip] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_TabHovered] = faded(p.accent, 0.20f);
  c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = faded(p.accent, is_light ? 0.3f : 0.35f);
  c[ImGuiCol_PlotLines] = p.accent;
  c[ImGuiCol_PlotHistogram] = p.accent;
  c[ImGuiCol_TableHeaderBg] = field;
  c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = p.line;
  c[ImGuiCol_TableRowBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_TableRowBgAlt] = faded(p.text, 0.03f);
  c[ImGuiCol_TextSelectedBg] = faded(p.accent, 0.35f);
  c[ImGuiCol_NavHighlight] = p.accent;
  c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.35f);
}

}  // namespace

const Palette& palette() {
  return current();
}

void apply_theme(Theme theme, float scale) {
  const bool is_light = theme == Theme::light;
  current() = is_light ? light() : dark();
  ImGuiStyle style;
  set_sizes(style);
  style.ScaleAllSizes(scale);
  set_colours(style, current(), is_light);
  ImGui::GetStyle() = style;
}

}  // namespace pedicel::app
