#pragma once

#include <string>
#include <vector>

namespace pedicel::plots {

/// Values over directions: 0 points down, as a fruit hangs, and angles go on to the right and up.
struct PolarPlot {
  std::string title;
  std::string label;          ///< of the values, with its unit
  std::vector<double> angle;  ///< rad
  std::vector<double> value;  ///< of equal length, >= 0; NaN: there is none, marked at the rim
  int size = 420;             ///< px
};

/// One <svg> element. Throws UsageError where the lists differ in length or are empty.
std::string to_svg(const PolarPlot& plot);

}  // namespace pedicel::plots
