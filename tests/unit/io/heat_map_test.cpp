#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "engine/core/check.h"
#include "engine/plots/svg_heat_map.h"

namespace pedicel::plots {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

HeatMap small() {
  return {"Residual",     "time (s)",   "rms",
          {"m1", "m<2>"}, {0, 1, 2, 4}, {{0.5, 3, 3}, {0.5, 0.5, 12}},
          {1, 2, 5, 10}};
}

/// Width over all rectangles of one colour, px.
double painted(const std::string& svg, const std::string& colour) {
  std::smatch path;
  if (!std::regex_search(svg, path, std::regex("<path fill=\"" + colour + "\" d=\"([^\"]*)\"")))
    return 0.0;
  const std::string text = path[1];
  const std::regex move("M[-0-9.]+ [-0-9.]+h([0-9.]+)");
  double sum = 0.0;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), move); it != std::sregex_iterator();
       ++it)
    sum += std::stod((*it)[1]);
  return sum;
}

TEST(HeatMap, CellsCoverTheirShareOfTheAxis) {
  const std::string svg = to_svg(small());
  // Pale: a quarter of the first row, half of the second. The two equal cells are one rectangle.
  const double pale = painted(svg, "#f4f6f8"), middle = painted(svg, "#3f82b5"),
               dark = painted(svg, "#6b1220");
  EXPECT_GT(pale, 0.0);
  EXPECT_NEAR(middle, pale, 0.3) << "three quarters of one row";
  EXPECT_NEAR(dark, 2.0 / 3.0 * pale, 0.3) << "half of one row";
}

TEST(HeatMap, NamesLevelsAndAxisAreWritten) {
  const std::string svg = to_svg(small());
  for (const char* words :
       {">Residual<", ">m1<", ">m&lt;2&gt;<", ">time (s)<", ">below 1<", ">from 10<", ">rms<"})
    EXPECT_THAT(svg, HasSubstr(words));
  EXPECT_THAT(svg, Not(HasSubstr("nothing measured")));
}

TEST(HeatMap, GapsAreSaid) {
  HeatMap map = small();
  map.value[1] = {nan, nan, nan};
  const std::string svg = to_svg(map);
  EXPECT_THAT(svg, HasSubstr(">nothing measured<"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(HeatMap, RefusesWhatDoesNotFit) {
  for (int fault = 0; fault < 4; ++fault) {
    HeatMap map = small();
    if (fault == 0) map.value[0].pop_back();
    if (fault == 1) map.rows.pop_back();
    if (fault == 2) map.levels = {2, 1};
    if (fault == 3) map.width = 100;
    EXPECT_THAT([&] { to_svg(map); },
                ThrowsMessage<UsageError>(HasSubstr("heat map \"Residual\"")));
  }
}

}  // namespace
}  // namespace pedicel::plots
