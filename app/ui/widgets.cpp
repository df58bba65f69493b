#include "app/ui/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "app/ui/drag_bar.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"

namespace pedicel::app {

namespace {

/// The number that a field shows for a value.
double as_shown(double value, const char* format) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return std::strtod(text.data(), nullptr);
}

}  // namespace

void heading(const Ui& ui, const char* text) {
  ImGui::Spacing();
  ImGui::PushFont(ui.bold);
  ImGui::TextColored(palette().dim, "%s", text);
  ImGui::PopFont();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float y = 0.5f * (low.y + high.y), right = low.x + ImGui::GetContentRegionAvail().x;
  const float left = high.x + ImGui::GetStyle().ItemSpacing.x;
  if (left < right)
    ImGui::GetWindowDrawList()->AddLine(ImVec2(left, y), ImVec2(right, y),
                                        colour_u32(palette().line));
}

void stay_in_row(const char* label) {
  const float wide =
      ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(label).x;
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < wide) ImGui::NewLine();
}

float rest_width(float right) {
  return std::max(10.0f, ImGui::GetContentRegionAvail().x - right);
}

std::string elide(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string cut = text;
  while (!cut.empty() && ImGui::CalcTextSize((cut + "...").c_str()).x > width) {
    char last = 0;
    do {  // bytes after the first of a letter belong to it
      last = cut.back();
      cut.pop_back();
    } while ((last & 0xC0) == 0x80 && !cut.empty());
  }
  return cut + "...";
}

void elided(const std::string& text, float width, const ImVec4* colour) {
  const std::string shown = elide(text, width);
  if (colour)
    ImGui::TextColored(*colour, "%s", shown.c_str());
  else
    ImGui::TextUnformatted(shown.c_str());
  if (shown != text) tip(text);
}

void row(const char* name, const std::string& value) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float name_width = ImGui::CalcTextSize(name).x + ImGui::GetStyle().ItemSpacing.x;
  ImGui::TextColored(palette().dim, "%s", name);
  const std::string shown = elide(value, std::max(10.0f, width - name_width));
  const float place = width - ImGui::CalcTextSize(shown.c_str()).x;
  const float left = ImGui::GetCursorPosX();
  ImGui::SameLine();
  // Not SameLine(x): in a table that counts from the column, the cursor from the window.
  ImGui::SetCursorPosX(left + std::max(place, name_width));
  ImGui::TextUnformatted(shown.c_str());
  if (shown != value) tip(value);
}

void note(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
  ImGui::TextWrapped("%s", at_blanks(text).c_str());
  ImGui::PopStyleColor();
}

std::string at_blanks(const std::string& text) {
  const float room = ImGui::GetContentRegionAvail().x;
  std::string all, line;
  const auto end_word = [&](const std::string& word) {
    const std::string longer = line.empty() ? word : line + " " + word;
    if (line.empty() || ImGui::CalcTextSize(longer.c_str()).x <= room) {
      line = longer;
      return;
    }
    all += line + "\n";
    line = word;
  };
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", start), text.size());
    end_word(text.substr(start, end - start));
    if (end < text.size() && text[end] == '\n') all += line + "\n", line.clear();
    start = end + 1;
  }
  return all + line;
}

bool wide_button(const char* label) {
  return ImGui::Button(label, ImVec2(-1, 0));
}

std::string number_text(double value, int digits) {
  std::array<char, 48> text{};
  const double size = std::abs(value);
  if (value == 0.0) return "0";
  if (!std::isfinite(value)) return std::isnan(value) ? "none" : (value > 0 ? "inf" : "-inf");
  if (size < 1e5 && size >= 1e-3) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
  }
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
  std::string shown = text.data();  // 4.5000e+08: without the zeros that say nothing
  const std::size_t e = shown.find('e'), last = shown.find_last_not_of('0', e - 1);
  if (shown.find('.') != std::string::npos)
    shown.erase(shown[last] == '.' ? last : last + 1, e - (shown[last] == '.' ? last : last + 1));
  return shown;
}

std::string quantity_text(double value, const std::string& unit, int digits) {
  struct Prefix {
    double factor;
    const char* name;
  };
  constexpr std::array<Prefix, 7> prefixes = {
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "\xC2\xB5"}, {1e-9, "n"}}};
  const bool takes =
      unit == "m" || unit == "N" || unit == "Pa" || unit == "s" || unit == "J" || unit == "N m";
  const std::string tail = unit == "1" || unit.empty() ? "" : " " + unit;
  if (!takes || value == 0.0 || !std::isfinite(value)) return number_text(value, digits) + tail;
  for (const Prefix& prefix : prefixes)
    if (std::abs(value) >= 0.9995 * prefix.factor || prefix.factor == 1e-9)
      return number_text(value / prefix.factor, digits) + " " + prefix.name + unit;
  return {};
}

void caption(const Ui& ui, const std::string& name, const std::string& value, const ImVec4& colour,
             const std::string& what) {
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  const std::string shown = elide(name, rest_width(value_width + 10.0f * ui.scale));
  ImGui::TextColored(colour, "%s", shown.c_str());
  tip(!what.empty() ? what : shown != name ? name : "");
  ImGui::SameLine();
  // Not SameLine(x): see row().
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + rest_width(value_width));
  ImGui::TextColored(palette().dim, "%s", value.c_str());
}

bool slider(const Ui& ui, const std::string& name, double& value, double low, double high,
            const char* format, ImGuiSliderFlags flags, const std::string& what) {
  std::array<char, 64> text{};
  const double zero = 0.0;  // not -0.0
  std::snprintf(text.data(), text.size(), format, as_shown(value, format) == 0.0 ? zero : value);
  caption(ui, name, text.data(), palette().text, what);
  ImGui::PushID(name.c_str());
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(6.0f * ui.scale, 0.0f));
  ImGui::SetNextItemWidth(-1);
  const BarRange range{low, high, (flags & ImGuiSliderFlags_Logarithmic) != 0};
  const bool moved = drag_bar(ui, "##value", value, range);
  ImGui::PopStyleVar();
  ImGui::PopID();
  if (moved) value = std::clamp(value, low, high);
  tip((what.empty() ? "" : what + "\n") + std::string(how_to_drag));
  return moved;
}

namespace {

/// Whether the last item was left after it was edited; then what was typed is in `typed`. By Tab it
/// is left a picture before ImGui says so, and by then it shows the old value again.
template <typename T>
bool was_left(T& typed, bool edited) {
  static ImGuiID field = 0;
  static T last{};
  const ImGuiID id = ImGui::GetItemID();
  if (edited) field = id, last = typed;
  if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
  if (field == id) typed = last;
  field = 0;
  return true;
}

}  // namespace

// What was typed back as it was is no edit: the value may have more digits than are shown.
bool number_field(const char* id, double& value, const char* format) {
  double shown = value;
  const bool edited = ImGui::InputDouble(id, &shown, 0.0, 0.0, format);
  if (!was_left(shown, edited) || shown == as_shown(value, format)) return false;
  value = shown;
  return true;
}

bool labelled_number(const Ui& ui, const char* label, const char* unit, double& value) {
  ImGui::AlignTextToFramePadding();
  const float column = 0.42f * ImGui::GetContentRegionMax().x;
  elided(label, column - ImGui::GetCursorPosX() - 4.0f * ui.scale, &palette().dim);
  const float unit_width = ImGui::CalcTextSize(unit).x + 6.0f * ui.scale;
  ImGui::SameLine(column);
  ImGui::SetNextItemWidth(rest_width(*unit ? unit_width : 0.0f));
  ImGui::PushID(label);
  const bool typed = number_field("##number", value);
  ImGui::PopID();
  if (*unit) {
    ImGui::SameLine(0, 6.0f * ui.scale);
    ImGui::TextColored(palette().dim, "%s", unit);
  }
  return typed;
}

bool three_numbers(const Ui& ui, const char* label, Vec3& value, const char* format) {
  ImGui::TextColored(palette().dim, "%s", label);
  const float space = 4.0f * ui.scale;
  const float width = (rest_width() - 2 * space) / 3.0f;
  bool typed = false;
  ImGui::PushID(label);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis) ImGui::SameLine(0, space);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(axis);
    typed = number_field("##axis", value[axis], format) || typed;
    ImGui::PopID();
  }
  ImGui::PopID();
  return typed;
}

bool text_field(const char* id, std::string& text, const char* hint) {
  const bool edited = ImGui::InputTextWithHint(id, hint, &text);
  return was_left(text, edited);
}

}  // namespace pedicel::app
