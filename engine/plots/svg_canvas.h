#pragma once

#include <string>
#include <string_view>

#include "engine/plots/plot_scale.h"

namespace pedicel::plots {

/// The area of a plot inside its picture, px.
struct PlotFrame {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

/// Writes SVG elements; coordinates are rounded to a tenth of a pixel.
class SvgCanvas {
 public:
  /// `description` is read out by screen readers.
  SvgCanvas(int width, int height, std::string_view description);

  void line(double x0, double y0, double x1, double y1, std::string_view style);
  void text(double x, double y, std::string_view words, std::string_view style);
  /// Text that reads upwards.
  void upward_text(double x, double y, std::string_view words, std::string_view style);
  void element(std::string_view markup) { body_ += markup; }

  /// The frame, ticks with their grid lines, numbers and label of an axis.
  void x_axis(const PlotFrame& frame, const PlotScale& scale, const std::string& label);
  void y_axis(const PlotFrame& frame, const PlotScale& scale, const std::string& label);

  std::string finished() &&;

  /// Rounded to a tenth.
  static std::string number(double value);
  /// Estimated width of a text, px.
  static double text_width(std::string_view words, double font_px);

 private:
  std::string body_;
};

inline constexpr std::string_view style_title =
    "font-size=\"14\" font-weight=\"600\" fill=\"#1f2328\"";
inline constexpr std::string_view style_label = "font-size=\"12\" fill=\"#3d444d\"";
inline constexpr std::string_view style_label_middle =
    "font-size=\"12\" fill=\"#3d444d\" text-anchor=\"middle\"";

}  // namespace pedicel::plots
