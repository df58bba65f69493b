#pragma once

#include <imgui.h>

#include "app/ui/preferences.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

/// Colours that mean the same in every panel.
struct Palette {
  ImVec4 text, dim, accent, good, warning, error;
  ImVec4 window, panel, raised, line;
};
const Palette& palette();

/// Sets ImGui's style: colours and sizes for that scale (px a point).
void apply_theme(Theme theme, float scale);

inline ImU32 ink(const render::Colour& colour) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(colour.r, colour.g, colour.b, 1.0f));
}
inline ImU32 colour_u32(const ImVec4& colour, float alpha = 1.0f) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(colour.x, colour.y, colour.z, colour.w * alpha));
}

}  // namespace pedicel::app
