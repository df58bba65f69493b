#include "engine/plots/svg_canvas.h"

#include <algorithm>
#include <cstdio>

#include "engine/io/markup.h"

namespace pedicel::plots {

namespace {

constexpr std::string_view grid = "stroke=\"#e3e6ea\"";
constexpr std::string_view edge = "stroke=\"#8c959f\"";

/// " × 10⁻³": the power of ten that the tick texts leave out.
std::string with_power(const std::string& label, int power) {
  if (power == 0) return io::escape_markup(label);
  return io::escape_markup(label) + " \u00d7 10<tspan dy=\"-4\" font-size=\"9\">" +
         std::to_string(power) + "</tspan>";
}

}  // namespace

SvgCanvas::SvgCanvas(int width, int height, std::string_view description) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  body_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
          "\" viewBox=\"0 0 " + w + " " + h + "\" role=\"img\" aria-label=\"" +
          io::escape_markup(description) +
          "\" font-family=\"system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif\">"
          "\n<rect width=\"" +
          w + "\" height=\"" + h + "\" fill=\"#ffffff\"/>\n";
}

std::string SvgCanvas::number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  std::string short_text = text;
  if (short_text.ends_with(".0")) short_text.resize(short_text.size() - 2);
  return short_text == "-0" ? "0" : short_text;
}

double SvgCanvas::text_width(std::string_view words, double font_px) {
  // Count characters, not bytes of UTF-8.
  const auto letters = std::count_if(words.begin(), words.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  });
  return 0.58 * font_px * static_cast<double>(letters);
}

void SvgCanvas::line(double x0, double y0, double x1, double y1, std::string_view style) {
  body_ += "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) +
           "\" y2=\"" + number(y1) + "\" " + std::string(style) + "/>\n";
}

void SvgCanvas::text(double x, double y, std::string_view words, std::string_view style) {
  body_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + std::string(style) + ">" +
           io::escape_markup(words) + "</text>\n";
}

void SvgCanvas::upward_text(double x, double y, std::string_view words, std::string_view style) {
  body_ += "<text transform=\"translate(" + number(x) + " " + number(y) + ") rotate(-90)\" " +
           std::string(style) + ">" + io::escape_markup(words) + "</text>\n";
}

void SvgCanvas::x_axis(const PlotFrame& frame, const PlotScale& scale, const std::string& label) {
  for (const Tick& tick : scale.ticks(80.0)) {
    const double x = scale(tick.value);
    line(x, frame.top, x, frame.bottom, grid);
    line(x, frame.bottom, x, frame.bottom + 4, edge);
    text(x, frame.bottom + 17, tick.text, style_label_middle);
  }
  line(frame.left, frame.bottom, frame.right, frame.bottom, edge);
  body_ += "<text x=\"" + number(0.5 * (frame.left + frame.right)) + "\" y=\"" +
           number(frame.bottom + 36) + "\" " + std::string(style_label_middle) + ">" +
           with_power(label, scale.exponent()) + "</text>\n";
}

void SvgCanvas::y_axis(const PlotFrame& frame, const PlotScale& scale, const std::string& label) {
  for (const Tick& tick : scale.ticks(45.0)) {
    const double y = scale(tick.value);
    line(frame.left, y, frame.right, y, grid);
    line(frame.left - 4, y, frame.left, y, edge);
    text(frame.left - 7, y + 4, tick.text, "font-size=\"12\" fill=\"#3d444d\" text-anchor=\"end\"");
  }
  line(frame.left, frame.top, frame.left, frame.bottom, edge);
  body_ += "<text transform=\"translate(16 " + number(0.5 * (frame.top + frame.bottom)) +
           ") rotate(-90)\" " + std::string(style_label_middle) + ">" +
           with_power(label, scale.exponent()) + "</text>\n";
}

std::string SvgCanvas::finished() && {
  return std::move(body_) + "</svg>\n";
}

}  // namespace pedicel::plots
