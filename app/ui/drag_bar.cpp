#include "app/ui/drag_bar.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

#include "app/ui/ui.h"

namespace pedicel::app {

namespace {

constexpr double least_decade = 160.0;  // points of the layout
constexpr double floor_share = 1.0e-6;  // of the upper end, where a logarithmic bar begins at 0

/// The bar in hand; ImGui has one active item at a time, too.
struct Held {
  double start = 0.0;
  float from = 0.0f;  // px
  std::array<char, 64> typed{};
};
Held held;

double lower_end(const BarRange& range) {
  return range.low > 0.0 ? range.low : floor_share * range.high;
}

/// Where a value is on the bar, 0 to 1.
double share_of(double value, const BarRange& range) {
  double share = 0.0;
  if (!range.logarithmic)
    share = (value - range.low) / std::max(range.high - range.low, 1e-300);
  else if (const double low = lower_end(range); value > low)
    share = std::log(value / low) / std::log(range.high / low);
  return std::clamp(share, 0.0, 1.0);
}

/// Rounded to a power of ten below what a px is.
double rounded(double value, double px_step) {
  if (!(px_step > 0.0) || !std::isfinite(value)) return value;
  const double quantum = std::pow(10.0, std::floor(std::log10(px_step)));
  return std::round(value / quantum) * quantum;
}

/// A decimal comma is as good as a point.
std::optional<double> number_in(const char* text) {
  std::string plain(text);
  std::replace(plain.begin(), plain.end(), ',', '.');
  const std::size_t start = plain.find_first_not_of(" +");
  if (start == std::string::npos) return {};
  double value = 0.0;
  const auto end = plain.data() + plain.find_last_not_of(' ') + 1;
  const auto read = std::from_chars(plain.data() + start, end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return {};
  return value;
}

void paint(const ImRect& box, ImGuiID id, double share, float scale) {
  const bool active = ImGui::GetActiveID() == id, hovered = ImGui::GetHoveredID() == id;
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::RenderFrame(box.Min, box.Max,
                     ImGui::GetColorU32(active    ? ImGuiCol_FrameBgActive
                                        : hovered ? ImGuiCol_FrameBgHovered
                                                  : ImGuiCol_FrameBg),
                     true, style.FrameRounding);
  const float grab = std::max(style.GrabMinSize, 6.0f * scale), pad = 2.0f * scale;
  const float room = box.GetWidth() - 2 * pad - grab;
  const float left = box.Min.x + pad + static_cast<float>(share) * std::max(room, 0.0f);
  ImGui::GetWindowDrawList()->AddRectFilled(
      ImVec2(left, box.Min.y + pad), ImVec2(left + grab, box.Max.y - pad),
      ImGui::GetColorU32(active ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab),
      style.GrabRounding);
}

bool type_in(const ImRect& box, ImGuiID id, const char* label, double& value) {
  const bool entered = ImGui::TempInputText(
      box, id, label, held.typed.data(), static_cast<int>(held.typed.size()),
      ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
  if (!entered && !ImGui::IsItemDeactivatedAfterEdit()) return false;
  const auto typed = number_in(held.typed.data());
  if (!typed || *typed == value) return false;
  value = *typed;
  return true;
}

bool press(ImGuiID id, ImGuiWindow* window, double value) {
  ImGui::SetActiveID(id, window);
  ImGui::SetFocusID(id, window);
  ImGui::FocusWindow(window);
  const ImGuiIO& io = ImGui::GetIO();
  held.start = value;
  held.from = io.MousePos.x;
  std::snprintf(held.typed.data(), held.typed.size(), "%.6g", value);
  return io.KeyCtrl || io.MouseDoubleClicked[0];
}

}  // namespace

double dragged_value(double start, double px, double width, double scale, const BarRange& range) {
  if (px == 0.0) return start;
  if (!range.logarithmic) {
    const double step = (range.high - range.low) / std::max(width, 1.0);
    const double value = std::clamp(start + px * step, range.low, range.high);
    return range.whole ? std::round(value) : rounded(value, step);
  }
  const double low = lower_end(range), decades = std::log10(range.high / low);
  const double decade = std::max(least_decade * scale, width / std::max(decades, 1e-9));
  const double value = std::max(start, low) * std::pow(10.0, px / decade);
  if (value <= low) return range.low;
  if (value >= range.high) return range.high;
  return range.whole ? std::round(value) : rounded(value, value * std::log(10.0) / decade);
}

bool drag_bar(const Ui& ui, const char* id_text, double& value, const BarRange& range) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  if (window->SkipItems) return false;
  const ImGuiID id = window->GetID(id_text);
  const ImVec2 low = window->DC.CursorPos;
  const ImRect box(low, ImVec2(low.x + ImGui::CalcItemWidth(), low.y + ImGui::GetFrameHeight()));
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  if (!ImGui::ItemAdd(box, id, &box, ImGuiItemFlags_Inputable)) return false;
  const ImGuiIO& io = ImGui::GetIO();
  bool types = ImGui::TempInputIsActive(id);
  if (!types && ImGui::ItemHoverable(box, id) && io.MouseClicked[0])
    types = press(id, window, value);
  if (types) return type_in(box, id, id_text, value);
  bool moved = false;
  if (ImGui::GetActiveID() == id) {
    const double px = (io.MousePos.x - held.from) * (io.KeyShift ? 0.1 : 1.0);
    const double now = dragged_value(held.start, px, box.GetWidth(), ui.scale, range);
    if (io.MouseDown[0] && now != value) {
      value = now;
      moved = true;
      ImGui::MarkItemEdited(id);
    }
    if (!io.MouseDown[0]) ImGui::ClearActiveID();
  }
  paint(box, id, share_of(value, range), ui.scale);
  return moved;
}

}  // namespace pedicel::app
