#include "engine/plots/svg_polar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/plots/svg_canvas.h"

namespace pedicel::plots {

namespace {

constexpr std::string_view style_ring = "fill=\"none\" stroke=\"#d0d7de\" stroke-width=\"1\"";
constexpr std::string_view style_spoke = "stroke=\"#d0d7de\" stroke-width=\"1\"";
constexpr std::string_view style_curve =
    "fill=\"none\" stroke=\"#0969da\" stroke-width=\"2\" stroke-linejoin=\"round\"";

/// A round number of rings that reaches a value.
double ring_step(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double part : {0.1, 0.2, 0.25, 0.5, 1.0, 2.0})
    if (most / (part * power) <= 5.0) return part * power;
  return 2.5 * power;
}

struct Disc {
  double x, y, radius, most;

  std::pair<double, double> at(double angle, double share) const {
    return {x + share * radius * std::sin(angle), y + share * radius * std::cos(angle)};
  }
};

std::string circle(double x, double y, double r, std::string_view style) {
  return "<circle cx=\"" + SvgCanvas::number(x) + "\" cy=\"" + SvgCanvas::number(y) + "\" r=\"" +
         SvgCanvas::number(r) + "\" " + std::string(style) + "/>";
}

void draw_grid(SvgCanvas& canvas, const Disc& disc, double step) {
  for (double value = step; value <= disc.most * 1.0001; value += step) {
    canvas.element(circle(disc.x, disc.y, disc.radius * value / disc.most, style_ring));
    canvas.text(disc.x + 3.0, disc.y - disc.radius * value / disc.most - 3.0,
                io::format_number(value, 3), "font-size=\"10\" fill=\"#57606a\"");
  }
  for (int turn = 0; turn < 12; ++turn) {
    const double angle = turn * std::numbers::pi / 6.0;
    const auto [x, y] = disc.at(angle, 1.0);
    canvas.line(disc.x, disc.y, x, y, style_spoke);
    const auto [tx, ty] = disc.at(angle, 1.1);
    canvas.text(tx, ty + 4.0, std::to_string(30 * turn) + "\u00b0", style_label_middle);
  }
}

/// The curve is broken where there is no value; a whole turn is closed.
void draw_curve(SvgCanvas& canvas, const Disc& disc, const PolarPlot& plot) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < plot.angle.size(); ++i) {
    if (std::isnan(plot.value[i])) {
      pen_down = false;
      continue;
    }
    const auto [x, y] = disc.at(plot.angle[i], plot.value[i] / disc.most);
    path += (pen_down ? " L" : " M") + SvgCanvas::number(x) + " " + SvgCanvas::number(y);
    pen_down = true;
  }
  if (!path.empty())
    canvas.element("<path d=\"" + path.substr(1) + "\" " + std::string(style_curve) + "/>");
  for (std::size_t i = 0; i < plot.angle.size(); ++i) {
    const bool none = std::isnan(plot.value[i]);
    const auto [x, y] = disc.at(plot.angle[i], none ? 1.0 : plot.value[i] / disc.most);
    canvas.element(circle(
        x, y, 3.5,
        none ? "fill=\"#ffffff\" stroke=\"#cf222e\" stroke-width=\"1.5\"" : "fill=\"#0969da\""));
  }
}

}  // namespace

std::string to_svg(const PolarPlot& plot) {
  if (plot.angle.size() != plot.value.size() || plot.angle.empty())
    throw UsageError("PolarPlot: " + std::to_string(plot.angle.size()) + " angles and " +
                     std::to_string(plot.value.size()) + " values: must be as many, and some");
  double most = 0.0;
  bool gaps = false;
  for (const double value : plot.value) {
    gaps |= std::isnan(value);
    if (!std::isnan(value)) most = std::max(most, value);
  }
  if (!(most > 0.0)) most = 1.0;
  const double step = ring_step(most);
  const double centre = 0.5 * plot.size;
  const Disc disc{centre, centre + 14.0, 0.37 * plot.size, step * std::ceil(most / step - 1e-9)};
  SvgCanvas canvas(plot.size, plot.size + 34, plot.title);
  canvas.text(12.0, 20.0, plot.title, style_title);
  canvas.text(12.0, 36.0, plot.label, style_label);
  draw_grid(canvas, disc, step);
  draw_curve(canvas, disc, plot);
  if (gaps) canvas.text(12.0, plot.size + 26.0, "Open circles: nothing broke.", style_label);
  return std::move(canvas).finished();
}

}  // namespace pedicel::plots
