#include "engine/plots/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/io/markup.h"
#include "engine/plots/svg_canvas.h"

namespace pedicel::plots {

namespace {

// Dark enough on white, told apart by lightness as well as by hue.
constexpr std::array<std::string_view, 7> palette = {"#1b6ca8", "#d1495b", "#2e8b57", "#8a5fbf",
                                                     "#c77d0a", "#3aa6a6", "#6b6f76"};

std::string colour_of(const std::string& wanted, std::size_t index) {
  return wanted.empty() ? std::string(palette[index % palette.size()]) : io::escape_markup(wanted);
}

void check_size(int width, int height) {
  if (width < 200 || height < 120)
    throw UsageError("plot of " + std::to_string(width) + " x " + std::to_string(height) +
                     " px: must be at least 200 x 120");
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) { low = std::min(low, value), high = std::max(high, value); }
};

bool plotted(double value, const PlotAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0.0);
}

/// The values of an axis: its fixed ends where given, else all that the other axis can show too.
PlotScale scale_of(const LinePlot& plot, bool of_x, double from, double to) {
  const PlotAxis& axis = of_x ? plot.x : plot.y;
  Range range;
  for (const PlotSeries& s : plot.series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (plotted(s.x[i], plot.x) && plotted(s.y[i], plot.y)) range.include((of_x ? s.x : s.y)[i]);
  for (const PlotBand& b : plot.bands)
    for (std::size_t i = 0; i < b.x.size(); ++i) {
      if (!plotted(b.x[i], plot.x)) continue;
      for (const double y : {b.low[i], b.high[i]})
        if (plotted(y, plot.y)) range.include(of_x ? b.x[i] : y);
    }
  if (of_x)
    for (const PlotEvent& e : plot.events)
      if (plotted(e.x, plot.x)) range.include(e.x);
  if (range.low > range.high) range = {axis.logarithmic ? 0.1 : 0.0, 1.0};
  const double low = axis.low.value_or(range.low);
  const double high = std::max(axis.high.value_or(range.high), low);
  PlotScale scale(low, high, from, to, axis.logarithmic);
  if (!of_x && !axis.low && !axis.high) scale.round_outwards();
  return scale;
}

double widest_tick(const PlotScale& scale) {
  double widest = 0.0;
  for (const Tick& tick : scale.ticks(45.0))
    widest = std::max(widest, SvgCanvas::text_width(tick.text, 12));
  return widest;
}

/// A legend entry: the swatch at x, y and its text beside it.
void legend_entry(SvgCanvas& canvas, const PlotSeries& s, std::size_t index, double x, double y) {
  const std::string stroke = "stroke=\"" + colour_of(s.colour, index) + "\" stroke-width=\"2\"" +
                             (s.dashed ? " stroke-dasharray=\"6 4\"" : "");
  if (s.line) canvas.line(x, y - 4, x + 24, y - 4, stroke);
  if (s.markers)
    canvas.element("<circle cx=\"" + SvgCanvas::number(x + 12) + "\" cy=\"" +
                   SvgCanvas::number(y - 4) + "\" r=\"3\" fill=\"" + colour_of(s.colour, index) +
                   "\"/>\n");
  canvas.text(x + 30, y, s.label, style_label);
}

void legend_entry(SvgCanvas& canvas, const PlotBand& band, std::size_t, double x, double y) {
  canvas.element("<rect x=\"" + SvgCanvas::number(x) + "\" y=\"" + SvgCanvas::number(y - 10) +
                 "\" width=\"24\" height=\"12\" fill=\"" + io::escape_markup(band.colour) +
                 "\" fill-opacity=\"0.55\"/>\n");
  canvas.text(x + 30, y, band.label, style_label);
}

/// Legend entries in rows above the plot; returns the height they take. Draws only with a canvas.
double legend(const LinePlot& plot, double left, double right, double top, SvgCanvas* canvas) {
  double x = left, y = top + 13;
  bool any = false;
  const auto place = [&](const auto& entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].label.empty()) continue;
      const double width = 30.0 + SvgCanvas::text_width(entries[i].label, 12) + 16.0;
      if (any && x + width > right) x = left, y += 18;
      any = true;
      if (canvas) legend_entry(*canvas, entries[i], i, x, y);
      x += width;
    }
  };
  place(plot.series);
  place(plot.bands);
  return any ? y - top + 10 : 6.0;
}

struct Pixel {
  double x, y;
};

/// Runs of points without gaps, thinned to first, lowest, highest and last of each pixel column.
std::vector<std::vector<Pixel>> runs_of(const PlotSeries& s, const LinePlot& plot,
                                        const PlotScale& x, const PlotScale& y) {
  std::vector<std::vector<Pixel>> runs(1);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!plotted(s.x[i], plot.x) || !plotted(s.y[i], plot.y)) {
      if (!runs.back().empty()) runs.emplace_back();
      continue;
    }
    runs.back().push_back({x(s.x[i]), y(s.y[i])});
  }
  if (runs.back().empty()) runs.pop_back();
  return runs;
}

std::vector<Pixel> thinned(const std::vector<Pixel>& points) {
  std::vector<Pixel> kept;
  std::size_t begin = 0;
  while (begin < points.size()) {
    std::size_t end = begin, low = begin, high = begin;
    for (; end < points.size() && std::floor(points[end].x) == std::floor(points[begin].x); ++end) {
      if (points[end].y < points[low].y) low = end;
      if (points[end].y > points[high].y) high = end;
    }
    std::array<std::size_t, 4> chosen = {begin, low, high, end - 1};
    std::sort(chosen.begin(), chosen.end());
    for (std::size_t k = 0; k < chosen.size(); ++k)
      if (k == 0 || chosen[k] != chosen[k - 1]) kept.push_back(points[chosen[k]]);
    begin = end;
  }
  return kept;
}

void draw_series(SvgCanvas& canvas, const LinePlot& plot, std::size_t index, const PlotScale& x,
                 const PlotScale& y) {
  const PlotSeries& s = plot.series[index];
  const std::string colour = colour_of(s.colour, index);
  for (const auto& run : runs_of(s, plot, x, y)) {
    if (s.line) {
      std::string points;
      for (const Pixel& p : thinned(run))
        points += SvgCanvas::number(p.x) + "," + SvgCanvas::number(p.y) + " ";
      canvas.element("<polyline fill=\"none\" stroke=\"" + colour +
                     "\" stroke-width=\"1.8\" stroke-linejoin=\"round\"" +
                     (s.dashed ? " stroke-dasharray=\"6 4\"" : "") + " points=\"" + points +
                     "\"/>\n");
    }
    if (!s.markers) continue;
    for (const Pixel& p : run)
      canvas.element("<circle cx=\"" + SvgCanvas::number(p.x) + "\" cy=\"" +
                     SvgCanvas::number(p.y) + "\" r=\"3.2\" fill=\"" + colour + "\"/>\n");
  }
}

/// One polygon a run of finite points: along the low edge and back along the high one.
void draw_band(SvgCanvas& canvas, const LinePlot& plot, const PlotBand& band, const PlotScale& x,
               const PlotScale& y) {
  const auto whole = [&](std::size_t i) {
    return plotted(band.x[i], plot.x) && plotted(band.low[i], plot.y) &&
           plotted(band.high[i], plot.y);
  };
  for (std::size_t begin = 0; begin < band.x.size();) {
    std::size_t end = begin;
    while (end < band.x.size() && whole(end)) ++end;
    // About one corner a pixel is all that shows.
    const auto pixels = static_cast<std::size_t>(plot.width);
    const std::size_t step = std::max<std::size_t>(1, (end - begin) / pixels);
    std::string there, back;
    for (std::size_t i = begin; i < end; i = i + 1 < end ? std::min(i + step, end - 1) : end) {
      const std::string px = SvgCanvas::number(x(band.x[i])) + ",";
      there += px + SvgCanvas::number(y(band.low[i])) + " ";
      back = px + SvgCanvas::number(y(band.high[i])) + " " + back;
    }
    if (end > begin + 1)
      canvas.element("<polygon fill=\"" + io::escape_markup(band.colour) +
                     "\" fill-opacity=\"0.55\" points=\"" + there + back + "\"/>\n");
    begin = end + 1;
  }
}

void draw_events(SvgCanvas& canvas, const LinePlot& plot, const PlotFrame& frame,
                 const PlotScale& x) {
  for (const PlotEvent& event : plot.events) {
    if (!plotted(event.x, plot.x) || !x.shows(event.x)) continue;
    const double px = x(event.x);
    canvas.line(px, frame.top, px, frame.bottom, "stroke=\"#57606a\" stroke-dasharray=\"3 3\"");
    // A white edge keeps the words readable where a curve passes.
    canvas.upward_text(px - 4, frame.top + 4, event.label,
                       "font-size=\"11\" fill=\"#57606a\" text-anchor=\"end\" stroke=\"#ffffff\" "
                       "stroke-width=\"3\" paint-order=\"stroke\"");
  }
}

}  // namespace

std::string to_svg(const LinePlot& plot) {
  check_size(plot.width, plot.height);
  for (const PlotSeries& s : plot.series)
    if (s.x.size() != s.y.size())
      throw UsageError("series \"" + s.label + "\" has " + std::to_string(s.x.size()) + " x and " +
                       std::to_string(s.y.size()) + " y: must be equally many");
  for (const PlotBand& b : plot.bands)
    if (b.x.size() != b.low.size() || b.x.size() != b.high.size())
      throw UsageError("band \"" + b.label + "\": x, low and high must be equally many");
  SvgCanvas canvas(plot.width, plot.height, plot.title);
  const double title = plot.title.empty() ? 8.0 : 30.0;
  PlotFrame frame{60, plot.width - 18.0, title, plot.height - 46.0};
  frame.top += legend(plot, 14, frame.right, title, nullptr);
  const PlotScale y = scale_of(plot, false, frame.bottom, frame.top);
  frame.left = std::max(46.0, 34.0 + widest_tick(y));
  const PlotScale x = scale_of(plot, true, frame.left, frame.right);
  canvas.text(14, 21, plot.title, style_title);
  legend(plot, 14, frame.right, title, &canvas);
  canvas.x_axis(frame, x, plot.x.label);
  canvas.y_axis(frame, y, plot.y.label);
  const auto side = [](double value) { return SvgCanvas::number(value); };
  // Nested picture: cuts off what fixed axis ends leave out, without ids that could clash on a
  // page.
  canvas.element("<svg x=\"" + side(frame.left) + "\" y=\"" + side(frame.top - 4) + "\" width=\"" +
                 side(frame.right - frame.left + 4) + "\" height=\"" +
                 side(frame.bottom - frame.top + 8) + "\" viewBox=\"" + side(frame.left) + " " +
                 side(frame.top - 4) + " " + side(frame.right - frame.left + 4) + " " +
                 side(frame.bottom - frame.top + 8) + "\">\n");
  for (const PlotBand& band : plot.bands) draw_band(canvas, plot, band, x, y);
  for (std::size_t i = 0; i < plot.series.size(); ++i) draw_series(canvas, plot, i, x, y);
  canvas.element("</svg>\n");
  draw_events(canvas, plot, frame, x);
  return std::move(canvas).finished();
}

std::string to_svg(const BarChart& chart) {
  check_size(chart.width, chart.height);
  SvgCanvas canvas(chart.width, chart.height, chart.title);
  Range range;
  range.include(0.0);
  for (const Bar& bar : chart.bars)
    if (std::isfinite(bar.value)) range.include(bar.value);
  if (range.low == range.high) range.high = 1.0;
  PlotFrame frame{60, chart.width - 18.0, chart.title.empty() ? 22.0 : 44.0, chart.height - 46.0};
  PlotScale y(range.low, range.high, frame.bottom, frame.top, false);
  y.round_outwards();
  frame.left = std::max(46.0, 34.0 + widest_tick(y));
  canvas.text(14, 21, chart.title, style_title);
  canvas.y_axis(frame, y, chart.y_label);
  const double slot = (frame.right - frame.left) / std::max<double>(1.0, chart.bars.size());
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const Bar& bar = chart.bars[i];
    const double middle = frame.left + (i + 0.5) * slot, thick = std::min(0.62 * slot, 90.0);
    const bool there = std::isfinite(bar.value);
    const double top = there ? y(std::max(bar.value, 0.0)) : y(0.0);
    const double low = there ? y(std::min(bar.value, 0.0)) : y(0.0);
    canvas.element("<rect x=\"" + SvgCanvas::number(middle - 0.5 * thick) + "\" y=\"" +
                   SvgCanvas::number(top) + "\" width=\"" + SvgCanvas::number(thick) +
                   "\" height=\"" + SvgCanvas::number(low - top) + "\" rx=\"2\" fill=\"" +
                   colour_of(bar.colour, 0) + "\"/>\n");
    canvas.text(middle, top - 5, there ? io::format_number(bar.value, 3) : "none",
                style_label_middle);
    canvas.text(middle, frame.bottom + 17, bar.label, style_label_middle);
  }
  canvas.line(frame.left, y(0.0), frame.right, y(0.0), "stroke=\"#8c959f\"");
  canvas.text(0.5 * (frame.left + frame.right), frame.bottom + 36, chart.x_label,
              style_label_middle);
  return std::move(canvas).finished();
}

}  // namespace pedicel::plots
