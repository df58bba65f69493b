#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pedicel::plots {

/// One curve or set of points.
struct PlotSeries {
  std::string label;         ///< in the legend; none where empty
  std::vector<double> x, y;  ///< of equal length; a point with a NaN breaks the line
  bool line = true;
  bool markers = false;
  bool dashed = false;
  std::string colour = {};  ///< "#rrggbb"; the next of the palette where empty
};

/// An axis: its label carries the unit, "time (s)".
struct PlotAxis {
  std::string label;
  bool logarithmic = false;                   ///< values that are not positive are left out
  std::optional<double> low = {}, high = {};  ///< fixed ends; from the data where absent
};

/// A vertical line at something that happened.
struct PlotEvent {
  double x = 0.0;
  std::string label;
};

/// A shaded area between two curves, drawn beneath the series.
struct PlotBand {
  std::string label;                 ///< in the legend; none where empty
  std::vector<double> x, low, high;  ///< of equal length; a point with a NaN breaks the area
  std::string colour = "#c9ced4";
};

/// A line plot.
struct LinePlot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotEvent> events = {};
  int width = 640, height = 360;  ///< px
  std::vector<PlotBand> bands = {};
};

struct Bar {
  std::string label;
  double value = 0.0;  ///< NaN: no bar, shown as "none"
  std::string colour = {};
};

/// Vertical bars from zero with their values above.
struct BarChart {
  std::string title;
  std::string x_label;
  std::string y_label;  ///< with its unit
  std::vector<Bar> bars;
  int width = 640, height = 360;  ///< px
};

/// One <svg> element, light theme, no fonts or files from elsewhere. The legend stands above the
/// plot area, where no curve can run through it. Long series are thinned to what the pixels can
/// show: first, lowest, highest and last of every pixel column. Throws UsageError where x and y of
/// a series (or a band's columns) differ in length or the size is below 200 x 120.
std::string to_svg(const LinePlot& plot);
std::string to_svg(const BarChart& chart);

}  // namespace pedicel::plots
