#include "engine/plots/svg_heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/io/markup.h"
#include "engine/plots/svg_canvas.h"

namespace pedicel::plots {

namespace {

// From pale to dark, told apart by lightness alone as well.
constexpr std::array<std::string_view, 9> ramp = {"#f4f6f8", "#d5e3ee", "#a9cbe2",
                                                  "#6fa8cf", "#3f82b5", "#f2b25c",
                                                  "#e07b39", "#c0392b", "#6b1220"};
constexpr std::string_view nothing = "#dcdcdc";
constexpr double row_height = 20.0;

std::string_view colour(double value, const std::vector<double>& levels) {
  if (std::isnan(value)) return nothing;
  const auto reached = std::ranges::upper_bound(levels, value) - levels.begin();
  // Spread over the ramp, so that few levels use it whole.
  const std::size_t steps = std::max<std::size_t>(levels.size(), 1);
  return ramp[std::min<std::size_t>((ramp.size() - 1) * reached / steps, ramp.size() - 1)];
}

void check(const HeatMap& map) {
  const std::size_t columns = map.edges.empty() ? 0 : map.edges.size() - 1;
  bool fits = map.value.size() == map.rows.size() && columns > 0 && map.width >= 300 &&
              map.levels.size() < ramp.size() && std::ranges::is_sorted(map.levels) &&
              std::ranges::is_sorted(map.edges);
  for (const auto& row : map.value) fits = fits && row.size() == columns;
  if (!fits)
    throw UsageError("heat map \"" + map.title + "\": must have one row of values a name, one " +
                     "value fewer than edges in each, at most 8 ascending levels, 300 px");
}

std::string rectangle(double x, double y, double width, double height) {
  using C = SvgCanvas;
  return "M" + C::number(x) + " " + C::number(y) + "h" + C::number(width) + "v" +
         C::number(height) + "h" + C::number(-width) + "z";
}

// Neighbouring cells of one colour are one rectangle, all of a colour one element.
void draw_cells(SvgCanvas& canvas, const HeatMap& map, const PlotFrame& frame, const PlotScale& x) {
  std::map<std::string_view, std::string> paths;
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    for (std::size_t c = 0; c < map.value[r].size();) {
      const std::string_view fill = colour(map.value[r][c], map.levels);
      std::size_t end = c + 1;
      while (end < map.value[r].size() && colour(map.value[r][end], map.levels) == fill) ++end;
      const double from = x(map.edges[c]);
      paths[fill] += rectangle(from, frame.top + row_height * static_cast<double>(r),
                               x(map.edges[end]) - from, row_height - 1.0);
      c = end;
    }
  for (const auto& [fill, path] : paths)
    canvas.element("<path fill=\"" + std::string(fill) + "\" d=\"" + path + "\"/>\n");
}

// "less", then each level's box with the number from which it counts; returns the height.
double legend(const HeatMap& map, double left, double right, double top, SvgCanvas* canvas) {
  std::vector<std::pair<std::string, std::string_view>> entries;
  const double below = map.levels.empty() ? 0.0 : map.levels.front() - 1.0;
  if (!map.levels.empty())
    entries.emplace_back("below " + io::format_number(map.levels.front(), 3),
                         colour(below, map.levels));
  for (const double level : map.levels)
    entries.emplace_back("from " + io::format_number(level, 3), colour(level, map.levels));
  const bool gaps = std::ranges::any_of(map.value, [](const auto& row) {
    return std::ranges::any_of(row, [](double v) { return std::isnan(v); });
  });
  if (gaps) entries.emplace_back("nothing measured", nothing);
  double x = left, y = top + 13;
  if (canvas) canvas->text(x, y, map.value_label, style_label);
  x += SvgCanvas::text_width(map.value_label, 12) + 16;
  for (const auto& [words, fill] : entries) {
    const double width = 20.0 + SvgCanvas::text_width(words, 12) + 12.0;
    if (x + width > right) x = left, y += 18;
    if (canvas) {
      canvas->element("<rect x=\"" + SvgCanvas::number(x) + "\" y=\"" + SvgCanvas::number(y - 10) +
                      "\" width=\"14\" height=\"12\" stroke=\"#c9ced4\" fill=\"" +
                      std::string(fill) + "\"/>\n");
      canvas->text(x + 20, y, words, style_label);
    }
    x += width;
  }
  return y - top + 12;
}

}  // namespace

std::string to_svg(const HeatMap& map) {
  check(map);
  double names = 0.0;
  for (const std::string& name : map.rows) names = std::max(names, SvgCanvas::text_width(name, 12));
  PlotFrame frame{std::min(24.0 + names, 0.4 * map.width), map.width - 18.0,
                  map.title.empty() ? 8.0 : 30.0, 0.0};
  const double title = frame.top;
  frame.top += legend(map, 14, frame.right, title, nullptr);
  frame.bottom = frame.top + row_height * static_cast<double>(map.rows.size());
  SvgCanvas canvas(map.width, static_cast<int>(frame.bottom + 46.0), map.title);
  const PlotScale x(map.edges.front(), map.edges.back(), frame.left, frame.right, false);
  canvas.text(14, 21, map.title, style_title);
  legend(map, 14, frame.right, title, &canvas);
  canvas.x_axis(frame, x, map.x_label);
  draw_cells(canvas, map, frame, x);
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    canvas.text(frame.left - 8, frame.top + row_height * (static_cast<double>(r) + 0.5) + 4,
                map.rows[r], "font-size=\"12\" fill=\"#3d444d\" text-anchor=\"end\"");
  return std::move(canvas).finished();
}

}  // namespace pedicel::plots
