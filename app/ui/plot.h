#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace pedicel::app {

/// A line of a plot. Values that are not finite leave a gap.
struct PlotLine {
  std::string name;
  ImU32 colour = 0;
  std::vector<double> x, y;  ///< of equal length, x increasing
};

/// What a plot shows; kept between pictures.
struct PlotView {
  bool follows = true;  ///< shows everything there is
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
};

/// A plot over time as big as that: wheel zooms time (with Ctrl values), drag pans, double click
/// shows everything again. The values under the pointer are named.
void draw_plot(const char* id, const std::vector<PlotLine>& lines, PlotView& view,
               const ImVec2& size, const char* x_label);

/// The names of the lines over the plot that was drawn last, in the corner where they hide least;
/// not where there is no room.
void name_lines(const std::vector<PlotLine>& lines, const PlotView& view);

/// A tick's number with the digits by which it differs from the next one, which is `step` off.
std::string tick_text(double value, double step);

/// Steps of 1, 2 or 5 times a power of ten, at most `most` of them between low and high.
std::vector<double> ticks(double low, double high, int most);

/// The colour of the n-th line.
ImU32 line_colour(int n);

}  // namespace pedicel::app
