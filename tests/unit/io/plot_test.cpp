#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/plots/plot_scale.h"
#include "engine/plots/svg_plot.h"

namespace pedicel::plots {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

int count(const std::string& text, const std::string& what) {
  int found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

/// Every y coordinate of the first polyline.
std::vector<double> polyline_y(const std::string& svg) {
  const std::size_t from = svg.find("points=\"") + 8;
  const std::string points = svg.substr(from, svg.find('"', from) - from);
  std::vector<double> values;
  const std::regex pair("[-0-9.]+,([-0-9.]+)");
  for (auto it = std::sregex_iterator(points.begin(), points.end(), pair);
       it != std::sregex_iterator(); ++it)
    values.push_back(std::stod((*it)[1]));
  return values;
}

LinePlot simple(std::vector<double> x, std::vector<double> y) {
  LinePlot plot;
  plot.title = "Strain";
  plot.x.label = "time (s)";
  plot.y.label = "strain (1)";
  plot.series = {{"stalk", std::move(x), std::move(y)}};
  return plot;
}

TEST(PlotScale, TicksAreRoundInsideAndEvenlySpaced) {
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const double low = random.normal() * std::pow(10.0, random.integer(-8, 8));
    const double high = low + std::pow(10.0, random.uniform(-6, 6)) * (std::abs(low) + 1e-9);
    const PlotScale scale(low, high, 0.0, 600.0, false);
    const auto ticks = scale.ticks(80.0);
    ASSERT_GE(ticks.size(), 2u) << low << " " << high;
    ASSERT_LE(ticks.size(), 9u);
    const double step = ticks[1].value - ticks[0].value;
    const double leading = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    EXPECT_TRUE(std::abs(leading - 1) < 1e-3 || std::abs(leading - 2) < 1e-3 ||
                std::abs(leading - 5) < 1e-3)
        << step;
    for (const Tick& tick : ticks) {
      EXPECT_GE(tick.value, low - 1e-6 * step);
      EXPECT_LE(tick.value, high + 1e-6 * step);
    }
  }
}

TEST(PlotScale, TickTextsAreShort) {
  const PlotScale strain(0.0, 0.2, 300.0, 0.0, false);
  EXPECT_EQ(strain.ticks(45.0).front().text, "0.00");
  EXPECT_EQ(strain.ticks(45.0).back().text, "0.20");
  const PlotScale modulus(0.0, 3e7, 300.0, 0.0, false);
  EXPECT_EQ(modulus.exponent(), 6);
  EXPECT_EQ(modulus.ticks(45.0).back().text, "30");
  const PlotScale tiny(0.0, 4e-6, 300.0, 0.0, false);
  EXPECT_EQ(tiny.exponent(), -6);
  EXPECT_EQ(tiny.ticks(80.0).back().text, "4");
}

TEST(PlotScale, LogarithmicTicksAreDecades) {
  const PlotScale scale(1e-5, 1e-1, 0.0, 400.0, true);
  const auto ticks = scale.ticks(80.0);
  ASSERT_EQ(ticks.size(), 5u);
  EXPECT_NEAR(scale(1e-3), 200.0, 1e-9);
  EXPECT_EQ(PlotScale(1.0, 10.0, 0.0, 400.0, true).ticks(80.0).size(), 4u);  // 1, 2, 5, 10
}

TEST(PlotScale, SingleValueGetsRoomOnBothSides) {
  for (const double value : {0.0, 5.0, -3e7}) {
    const PlotScale scale(value, value, 0.0, 100.0, false);
    EXPECT_NEAR(scale(value), 50.0, 1e-9);
    EXPECT_LT(scale.low(), scale.high());
  }
}

TEST(LinePlot, DrawsTitleAxesLegendAndCurve) {
  const std::string svg = to_svg(simple({0, 1, 2}, {0, 0.1, 0.2}));
  EXPECT_EQ(svg.find("<svg "), 0u);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  for (const char* words : {">Strain<", ">time (s)<", ">strain (1)<", ">stalk<", ">0.20<"})
    EXPECT_THAT(svg, HasSubstr(words));
  EXPECT_EQ(count(svg, "<polyline"), 1);
  const auto y = polyline_y(svg);
  ASSERT_EQ(y.size(), 3u);
  EXPECT_NEAR(y[1], 0.5 * (y[0] + y[2]), 0.11) << "a straight line is drawn straight";
  EXPECT_LT(y[2], y[0]) << "up is up";
}

// The legend stands above the plot area: no curve point may lie at its height.
TEST(LinePlot, LegendNeverMeetsTheData) {
  LinePlot plot = simple({0, 1}, {1, 1});
  for (int i = 0; i < 9; ++i)
    plot.series.push_back({"a rather long name of a series", {0, 1}, {1.0 * i, 1.0 * i}});
  const std::string svg = to_svg(plot);
  double lowest_label = 0.0;
  const std::regex label("y=\"([0-9.]+)\"[^>]*>(stalk|a rather)");
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), label); it != std::sregex_iterator();
       ++it)
    lowest_label = std::max(lowest_label, std::stod((*it)[1]));
  EXPECT_GT(lowest_label, 60.0) << "long legends wrap";
  for (const double y : polyline_y(svg)) EXPECT_GT(y, lowest_label);
}

TEST(LinePlot, GapsBreakTheLine) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(count(to_svg(simple({0, 1, 2, 3, 4}, {0, 1, nan, 1, 0})), "<polyline"), 2);
  EXPECT_EQ(count(to_svg(simple({0, 1}, {nan, nan})), "<polyline"), 0);
  EXPECT_THAT(to_svg(simple({0, 1, 2}, {nan, 1, nan})), Not(HasSubstr("nan")));
}

TEST(LinePlot, LongSeriesAreThinnedButKeepTheirPeaks) {
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) x.push_back(i), y.push_back(std::sin(0.01 * i));
  y[54321] = 5.0;
  const LinePlot plot = simple(x, y);
  const std::string svg = to_svg(plot);
  EXPECT_LT(polyline_y(svg).size(), 4u * 640u);
  const auto drawn = polyline_y(svg);
  const auto [peak, valley] = std::minmax_element(drawn.begin(), drawn.end());
  // From -1 to the peak at 5 it is six times as far as from -1 to the first value, 0.
  EXPECT_NEAR(*valley - *peak, 6.0 * (*valley - drawn[0]), 3.0);
}

TEST(LinePlot, EventsMarkersAndDashes) {
  LinePlot plot = simple({0, 1, 2}, {0, 1, 2});
  plot.series[0].markers = true;
  plot.series[0].dashed = true;
  plot.events = {{1.5, "breaks <here>"}, {3.0, "last"}};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(count(svg, "<circle"), 3 + 1);
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(svg, HasSubstr("breaks &lt;here&gt;"));
  EXPECT_THAT(svg, HasSubstr(">last<")) << "events widen the axis";
}

TEST(LinePlot, LogarithmicAxisLeavesOutWhatItCannotShow) {
  LinePlot plot = simple({1, 10, 100}, {0.0, 1e-3, -1.0});
  plot.x.logarithmic = plot.y.logarithmic = true;
  EXPECT_THAT(to_svg(plot), Not(HasSubstr("nan")));
  EXPECT_THAT(to_svg(plot), Not(HasSubstr("inf")));
}

TEST(LinePlot, EmptyPlotStillHasAxes) {
  EXPECT_THAT(to_svg(LinePlot{.title = "nothing", .x = {}, .y = {}, .series = {}}),
              HasSubstr(">nothing<"));
}

// The area's corners are those of its edges, beneath the curve, and the axes hold all of it.
TEST(LinePlot, BandLiesBeneathTheSeries) {
  LinePlot plot = simple({0, 1, 2}, {0, 1, 2});
  plot.bands = {{"noise", {0, 1, 2}, {-1, 0, 1}, {1, 2, 5}}};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(count(svg, "<polygon"), 1);
  EXPECT_LT(svg.find("<polygon"), svg.find("<polyline"));
  EXPECT_THAT(svg, HasSubstr(">noise<"));
  const std::regex corners("<polygon[^>]*points=\"([^\"]*)\"");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(svg, match, corners));
  EXPECT_EQ(count(match[1], ","), 6);
  // From low -1 to high 5 at the ends: six units against the curve's two.
  const std::string text = match[1];
  std::vector<double> y;
  const std::regex pair("[-0-9.]+,([-0-9.]+)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pair); it != std::sregex_iterator();
       ++it)
    y.push_back(std::stod((*it)[1]));
  const auto curve = polyline_y(svg.substr(svg.find("<polyline")));
  EXPECT_NEAR(y[0] - y[3], 3.0 * (curve[0] - curve[2]), 0.5);
}

TEST(LinePlot, GapsBreakTheBand) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LinePlot plot = simple({0, 1}, {0, 1});
  plot.bands = {{"", {0, 1, 2, 3, 4}, {0, 0, nan, 0, 0}, {1, 1, 1, 1, 1}}};
  EXPECT_EQ(count(to_svg(plot), "<polygon"), 2);
  plot.bands[0].low.pop_back();
  EXPECT_THAT([&] { to_svg(plot); }, ThrowsMessage<UsageError>(HasSubstr("equally many")));
}

TEST(LinePlot, RefusesMisuse) {
  EXPECT_THAT(
      [] {
        to_svg(simple({0, 1}, {0}));
      },
      ThrowsMessage<UsageError>(
          HasSubstr("series \"stalk\" has 2 x and 1 y: must be equally many")));
  LinePlot small = simple({0}, {0});
  small.width = 100;
  EXPECT_THAT([&] { to_svg(small); },
              ThrowsMessage<UsageError>(HasSubstr("100 x 360 px: must be at least 200 x 120")));
}

TEST(BarChart, BarsStandOnZero) {
  BarChart chart{"Time to detach", "C_s^max (1)", "time (s)", {{"0.05", 1.0}, {"0.10", -2.0}}};
  const std::string svg = to_svg(chart);
  const std::regex rect(
      "<rect x=\"[0-9.]+\" y=\"([0-9.]+)\" width=\"[0-9.]+\" height=\"([0-9.]+)\" rx");
  std::vector<std::pair<double, double>> bars;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), rect); it != std::sregex_iterator();
       ++it)
    bars.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  ASSERT_EQ(bars.size(), 2u);
  EXPECT_NEAR(bars[0].first + bars[0].second, bars[1].first, 0.2);  // both touch zero
  EXPECT_NEAR(bars[1].second, 2.0 * bars[0].second, 0.3);
}

TEST(BarChart, MissingValueIsSaid) {
  BarChart chart{"t", "", "", {{"a", std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_THAT(to_svg(chart), HasSubstr(">none<"));
  EXPECT_THAT(to_svg(chart), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace pedicel::plots
