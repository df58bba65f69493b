#include "app/ui/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

struct PlotArea {
  ImVec2 low, high;  // px: upper left and lower right of the lines' place
  const PlotView& view;

  float x(double value) const {
    return low.x +
           static_cast<float>((value - view.x_low) / (view.x_high - view.x_low)) * (high.x - low.x);
  }
  float y(double value) const {
    return high.y -
           static_cast<float>((value - view.y_low) / (view.y_high - view.y_low)) * (high.y - low.y);
  }
  double value_x(float px) const {
    return view.x_low + (view.x_high - view.x_low) * (px - low.x) / (high.x - low.x);
  }
};

void show_all(const std::vector<PlotLine>& lines, PlotView& view) {
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (const PlotLine& line : lines)
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!std::isfinite(line.y[i])) continue;
      x0 = std::min(x0, line.x[i]), x1 = std::max(x1, line.x[i]);
      y0 = std::min(y0, line.y[i]), y1 = std::max(y1, line.y[i]);
    }
  if (!(x1 >= x0)) x0 = 0, x1 = 1, y0 = 0, y1 = 1;
  if (x1 - x0 < 1e-9) x1 = x0 + 1.0;
  // What hardly changes is a level line, not a picture of its last digits.
  const double most = std::max(std::abs(y0), std::abs(y1)), least = most > 0.0 ? 1e-3 * most : 1.0;
  const double margin = 0.06 * (y1 - y0) + 0.5 * std::max(0.0, least - (y1 - y0));
  view.x_low = x0, view.x_high = x1;
  view.y_low = y0 - margin, view.y_high = y1 + margin;
}

double spacing(const std::vector<double>& ticks) {
  return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
}

void draw_grid(ImDrawList& list, const PlotArea& frame, const char* x_label) {
  const float em = ImGui::GetFontSize();
  const ImU32 grid = colour_u32(palette().line, 0.6f), ink = colour_u32(palette().dim);
  const PlotView& v = frame.view;
  const int across = std::max(2, static_cast<int>((frame.high.x - frame.low.x) / (5 * em)));
  const int up = std::max(2, static_cast<int>((frame.high.y - frame.low.y) / (2.2f * em)));
  const std::vector<double> times = ticks(v.x_low, v.x_high, across);
  for (const double t : times) {
    const float x = frame.x(t);
    list.AddLine(ImVec2(x, frame.low.y), ImVec2(x, frame.high.y), grid);
    const std::string text = tick_text(t, spacing(times));
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    if (x + 0.5f * width < frame.high.x - ImGui::CalcTextSize(x_label).x - 0.4f * em)
      list.AddText(ImVec2(x - 0.5f * width, frame.high.y + 3), ink, text.c_str());
  }
  list.AddText(ImVec2(frame.high.x - ImGui::CalcTextSize(x_label).x, frame.high.y + 3), ink,
               x_label);
  const std::vector<double> values = ticks(v.y_low, v.y_high, up);
  for (const double value : values) {
    const float y = frame.y(value);
    list.AddLine(ImVec2(frame.low.x, y), ImVec2(frame.high.x, y), grid);
    const std::string text = tick_text(value, spacing(values));
    list.AddText(ImVec2(frame.low.x - ImGui::CalcTextSize(text.c_str()).x - 5, y - 0.5f * em), ink,
                 text.c_str());
  }
}

/// A line with at most two values a pixel: the least and the most of those that fall on it.
void draw_line(ImDrawList& list, const PlotArea& frame, const PlotLine& line) {
  const auto from = std::ranges::lower_bound(line.x, frame.view.x_low);
  std::size_t i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, from - line.x.begin() - 1));
  std::vector<ImVec2> points;
  const auto flush = [&] {
    if (points.size() > 1)
      list.AddPolyline(points.data(), static_cast<int>(points.size()), line.colour, 0,
                       0.107f * ImGui::GetFontSize());
    points.clear();
  };
  while (i < line.x.size() && (i == 0 || line.x[i - 1] <= frame.view.x_high)) {
    const float px = std::floor(frame.x(line.x[i]));
    double least = INFINITY, most = -INFINITY;
    bool gap = false;
    for (; i < line.x.size() && std::floor(frame.x(line.x[i])) <= px; ++i) {
      if (!std::isfinite(line.y[i]))
        gap = true;
      else
        least = std::min(least, line.y[i]), most = std::max(most, line.y[i]);
    }
    if (gap) flush();
    if (most < least) continue;
    points.push_back(ImVec2(px, frame.y(least)));
    if (frame.y(least) - frame.y(most) > 1.0f) points.push_back(ImVec2(px, frame.y(most)));
  }
  flush();
}

void draw_values(ImDrawList& list, const PlotArea& frame, const std::vector<PlotLine>& lines) {
  const double at = frame.value_x(ImGui::GetIO().MousePos.x);
  const float x = frame.x(at);
  list.AddLine(ImVec2(x, frame.low.y), ImVec2(x, frame.high.y), colour_u32(palette().dim, 0.6f));
  ImGui::BeginTooltip();
  ImGui::Text("%s s", number_text(at, 5).c_str());
  for (const PlotLine& line : lines) {
    if (line.x.empty()) continue;
    auto i = static_cast<std::size_t>(std::ranges::lower_bound(line.x, at) - line.x.begin());
    i = std::min(i, line.x.size() - 1);
    ImGui::PushStyleColor(ImGuiCol_Text, line.colour);
    ImGui::Text("%s: %s", line.name.c_str(), number_text(line.y[i], 5).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::EndTooltip();
}

void zoom(double& low, double& high, double about, double factor) {
  low = about + factor * (low - about);
  high = about + factor * (high - about);
}

void move_view(PlotView& view, const PlotArea& frame, const std::vector<PlotLine>& lines) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 2.0f)) {
    view.follows = false;
    const double dx = io.MouseDelta.x / (frame.high.x - frame.low.x) * (view.x_high - view.x_low);
    const double dy = io.MouseDelta.y / (frame.high.y - frame.low.y) * (view.y_high - view.y_low);
    view.x_low -= dx, view.x_high -= dx, view.y_low += dy, view.y_high += dy;
  }
  if (!ImGui::IsItemHovered()) return;
  if (io.MouseWheel != 0.0f) {
    view.follows = false;
    const double factor = std::pow(0.85, io.MouseWheel);
    const double share = (frame.high.y - io.MousePos.y) / (frame.high.y - frame.low.y);
    if (io.KeyCtrl)
      zoom(view.y_low, view.y_high, view.y_low + share * (view.y_high - view.y_low), factor);
    else
      zoom(view.x_low, view.x_high, frame.value_x(io.MousePos.x), factor);
  }
  if (ImGui::IsMouseDoubleClicked(0)) view.follows = true, show_all(lines, view);
}

PlotArea frame_of(const ImVec2& corner, const ImVec2& size, const PlotView& view) {
  const float em = ImGui::GetFontSize();
  return {ImVec2(corner.x + 4.2f * em, corner.y + 0.5f * em),
          ImVec2(corner.x + size.x - 0.6f * em, corner.y + size.y - 1.5f * em), view};
}

/// Where a box of that size hides the fewest values of the lines; the upper right one if alike.
ImVec2 emptiest_corner(const PlotArea& frame, const std::vector<PlotLine>& lines,
                       const ImVec2& size, float pad) {
  const float left = frame.low.x + pad, right = frame.high.x - pad - size.x;
  const float top = frame.low.y + pad, bottom = frame.high.y - pad - size.y;
  ImVec2 best(right, top);
  long fewest = -1;
  for (const ImVec2& at :
       {ImVec2(right, top), ImVec2(left, top), ImVec2(right, bottom), ImVec2(left, bottom)}) {
    long hidden = 0;
    for (const PlotLine& line : lines)
      for (std::size_t i = 0; i < line.x.size(); ++i) {
        const float x = frame.x(line.x[i]), y = frame.y(line.y[i]);
        hidden += x >= at.x && x <= at.x + size.x && y >= at.y && y <= at.y + size.y;
      }
    if (fewest >= 0 && hidden >= fewest) continue;
    fewest = hidden;
    best = at;
  }
  return best;
}

}  // namespace

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  const int last = static_cast<int>(std::floor(std::log10(step) + 1e-9));  // power that differs
  if (last < -4 || std::abs(value) >= 1e5) {
    const int first = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    return number_text(value, std::clamp(first - last + 1, 1, 6));
  }
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", std::max(0, -last), value);
  return text.data();
}

std::vector<double> ticks(double low, double high, int most) {
  if (!(high > low) || most < 1) return {};
  const double raw = (high - low) / most, power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double nice : {1.0, 2.0, 5.0})
    if (nice * power >= raw * (1 - 1e-9)) {
      step = nice * power;
      break;
    }
  std::vector<double> result;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    result.push_back(k == 0.0 ? 0.0 : k * step);
  return result;
}

ImU32 line_colour(int n) {
  constexpr std::array<ImU32, 6> colours = {
      IM_COL32(95, 175, 60, 255), IM_COL32(230, 140, 40, 255),  IM_COL32(60, 140, 220, 255),
      IM_COL32(215, 80, 80, 255), IM_COL32(160, 110, 210, 255), IM_COL32(60, 175, 170, 255)};
  return colours[static_cast<std::size_t>(n) % colours.size()];
}

void draw_plot(const char* id, const std::vector<PlotLine>& lines, PlotView& view,
               const ImVec2& size, const char* x_label) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(id, size);
  if (view.follows) show_all(lines, view);
  const PlotArea frame = frame_of(corner, size, view);
  if (frame.high.x - frame.low.x < em || frame.high.y - frame.low.y < em) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(frame.low, frame.high, colour_u32(palette().window, 0.6f), 3.0f);
  draw_grid(list, frame, x_label);
  list.PushClipRect(frame.low, frame.high, true);
  for (const PlotLine& line : lines) draw_line(list, frame, line);
  list.PopClipRect();
  move_view(view, frame, lines);
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) draw_values(list, frame, lines);
}

void name_lines(const std::vector<PlotLine>& lines, const PlotView& view) {
  const PlotArea frame = frame_of(ImGui::GetItemRectMin(), ImGui::GetItemRectSize(), view);
  const float pad = 0.4f * ImGui::GetFontSize(), height = ImGui::GetTextLineHeight();
  ImVec2 size(2 * pad, 2 * pad + static_cast<float>(lines.size()) * height);
  for (const PlotLine& line : lines)
    size.x = std::max(size.x, ImGui::CalcTextSize(line.name.c_str()).x + 2 * pad);
  const ImVec2 room(frame.high.x - frame.low.x, frame.high.y - frame.low.y);
  if (lines.empty() || 1.5f * size.x > room.x || size.y > 0.7f * room.y) return;
  ImVec2 at = emptiest_corner(frame, lines, size, pad);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, ImVec2(at.x + size.x, at.y + size.y), colour_u32(palette().window, 0.85f),
                     pad);
  at.x += pad, at.y += pad;
  for (const PlotLine& line : lines) {
    list.AddText(at, line.colour, line.name.c_str());
    at.y += height;
  }
}

}  // namespace pedicel::app
