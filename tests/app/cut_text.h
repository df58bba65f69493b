#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace pedicel::app {

/// A letter that the last picture shows only a part of, or not at all.
struct CutLetter {
  std::string window;
  float x = 0.0f, y = 0.0f;  // px, its upper left corner
};

/// Letters of the last picture that are cut at the left or right of what they stand in: by the
/// clipping of the picture, or by ImGui itself, which shortens a letter's rectangle. Above and
/// below they may be cut, that is what scrolling does.
inline std::vector<CutLetter> cut_letters() {
  const ImDrawData& data = *ImGui::GetDrawData();
  // The letters' places in the atlas, to see whether a rectangle has the whole of one.
  std::set<std::pair<int, int>> whole;
  const auto key = [](float u) { return static_cast<int>(std::lround(u * 65536.0f)); };
  for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
    for (const ImFontGlyph& glyph : font->Glyphs) whole.insert({key(glyph.U0), key(glyph.U1)});
  std::vector<CutLetter> cut;
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.GetTexID() != ImGui::GetIO().Fonts->TexID) continue;
      for (unsigned i = 0; i + 5 < command.ElemCount; ++i) {
        const auto* index = list.IdxBuffer.Data + command.IdxOffset + i;
        const ImDrawVert* first = list.VtxBuffer.Data + command.VtxOffset + index[0];
        // A letter is two triangles 0 1 2, 0 2 3 of a rectangle with a part of the atlas.
        if (index[1] != index[0] + 1 || index[2] != index[0] + 2 || index[3] != index[0] ||
            index[4] != index[0] + 2 || index[5] != index[0] + 3)
          continue;
        const ImDrawVert &a = first[0], &c = first[2];
        if (a.uv.x == c.uv.x || a.uv.y == c.uv.y) continue;  // a filled shape
        const bool in_rows = c.pos.y > command.ClipRect.y + 2 && a.pos.y < command.ClipRect.w - 2;
        if (!in_rows) continue;
        // Some letters lean a little out of their place.
        const float lean = 0.3f * (c.pos.x - a.pos.x) + 0.5f;
        const bool outside =
            a.pos.x < command.ClipRect.x - lean || c.pos.x > command.ClipRect.z + lean;
        const bool shortened = !whole.contains({key(a.uv.x), key(c.uv.x)});
        if (outside || shortened)
          cut.push_back({list._OwnerName ? list._OwnerName : "", a.pos.x, a.pos.y});
      }
    }
  }
  return cut;
}

/// Windows of the last picture in which something reaches farther to the right than they do, with
/// how far (px): ImGui leaves out whole letters beyond the edge.
inline std::vector<std::pair<std::string, float>> overflowing() {
  std::vector<std::pair<std::string, float>> found;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->WasActive || (window->Flags & ImGuiWindowFlags_Tooltip)) continue;
    const float room =
        window->InnerRect.GetWidth() + window->ScrollbarSizes.x - 2 * window->WindowPadding.x;
    if (window->ContentSize.x > room + 1.0f && window->ScrollMax.x == 0.0f)
      found.emplace_back(window->Name, window->ContentSize.x - room);
    else if (window->ScrollMax.x > 0.0f)
      found.emplace_back(window->Name, window->ScrollMax.x);
  }
  return found;
}

inline std::string describe(const std::vector<CutLetter>& cut) {
  std::string text;
  for (std::size_t i = 0; i < cut.size() && i < 6; ++i)
    text += cut[i].window + " at " + std::to_string(static_cast<int>(cut[i].x)) + ", " +
            std::to_string(static_cast<int>(cut[i].y)) + "\n";
  return text;
}

}  // namespace pedicel::app
