#include <cmath>

#include "engine/plots/svg_plot.h"
#include "tests/discrepancy/harvest/harvest.h"

namespace pedicel::harvest {

namespace {

constexpr const char* real_colour = "#1a1a1a";
constexpr const char* nominal_colour = "#c0392b";
constexpr const char* extended_colour = "#1b7837";

}  // namespace

std::string force_picture(const Trial& trial) {
  plots::LinePlot plot;
  plot.title = "Force at the wrist, " + trial.name + (trial.check ? ", held out" : "");
  plot.x.label = "time (s)";
  plot.y.label = "force (N)";
  const auto add = [&](const Course& course, const std::string& name, const char* colour,
                       bool dashed) {
    plot.series.push_back(
        {.label = name, .x = trial.time, .y = course.force, .dashed = dashed, .colour = colour});
    if (course.came_off) plot.events.push_back({*course.came_off, name});
  };
  add(trial.real, "real", real_colour, false);
  add(trial.nominal, "nominal", nominal_colour, false);
  if (trial.extended) add(*trial.extended, "extended", extended_colour, true);
  return to_svg(plot);
}

std::string shape_picture(const Trial& trial, bool from_side) {
  plots::LinePlot plot;
  plot.title = "Just before the fruit comes off, " + trial.name;
  plot.x.label = from_side ? "away from the robot, x (m)" : "aside, y (m)";
  plot.y.label = "height (m)";
  plot.width = plot.height = 360;
  const auto add = [&](const Course& course, const std::string& name, const char* colour,
                       bool dashed) {
    plots::PlotSeries line;
    line.label = name;
    line.markers = true;
    line.dashed = dashed;
    line.colour = colour;
    for (std::size_t p = 0; p < course.shape.size(); ++p) {
      const Vec3& point = course.shape[p];
      if (p == trial.stem) line.x.push_back(std::nan("")), line.y.push_back(std::nan(""));
      line.x.push_back(from_side ? point.x() : point.y());
      line.y.push_back(point.z());
    }
    plot.series.push_back(std::move(line));
  };
  add(trial.real, "real", real_colour, false);
  add(trial.nominal, "nominal", nominal_colour, false);
  if (trial.extended) add(*trial.extended, "extended", extended_colour, true);
  return to_svg(plot);
}

}  // namespace pedicel::harvest
