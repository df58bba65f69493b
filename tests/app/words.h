#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pedicel::app {

/// A letter of the last picture.
struct SeenLetter {
  char letter = '?';
  ImVec2 low, high;  // px
};

/// The letters that the last picture shows in windows whose names hold `window`, in the order they
/// were written; blanks leave no trace. ASCII only.
inline std::vector<SeenLetter> seen_letters(const std::string& window) {
  const auto key = [](const ImVec2& uv) {
    return std::pair{std::lround(uv.x * 65536.0f), std::lround(uv.y * 65536.0f)};
  };
  std::map<std::pair<long, long>, char> glyphs;
  for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
    for (const ImFontGlyph& glyph : font->Glyphs)
      if (glyph.Codepoint > 32 && glyph.Codepoint < 127)
        glyphs[key(ImVec2(glyph.U0, glyph.V0))] = static_cast<char>(glyph.Codepoint);
  std::vector<SeenLetter> seen;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    if (!list._OwnerName || std::string(list._OwnerName).find(window) == std::string::npos)
      continue;
    for (int i = 0; i + 5 < list.IdxBuffer.Size; ++i) {
      const ImDrawIdx* index = list.IdxBuffer.Data + i;
      if (index[1] != index[0] + 1 || index[2] != index[0] + 2 || index[3] != index[0] ||
          index[4] != index[0] + 2 || index[5] != index[0] + 3)
        continue;
      const ImDrawVert *a = list.VtxBuffer.Data + index[0], *c = a + 2;
      const auto glyph = glyphs.find(key(a->uv));
      if (a->uv.x == c->uv.x || glyph == glyphs.end()) continue;
      seen.push_back({glyph->second, a->pos, c->pos});
    }
  }
  return seen;
}

/// Where words stand in the last picture: the middle of the first place that says so, px; nothing
/// where none does.
inline std::optional<ImVec2> place_of(const std::string& window, const std::string& words) {
  const std::vector<SeenLetter> seen = seen_letters(window);
  std::string text, wanted;
  for (const SeenLetter& one : seen) text += one.letter;
  for (const char c : words)
    if (c != ' ') wanted += c;
  const std::size_t at = text.find(wanted);
  if (at == std::string::npos) return {};
  const SeenLetter &first = seen[at], &last = seen[at + wanted.size() - 1];
  return ImVec2(0.5f * (first.low.x + last.high.x), 0.5f * (first.low.y + last.high.y));
}

}  // namespace pedicel::app
