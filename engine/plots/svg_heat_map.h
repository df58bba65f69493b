#pragma once

#include <string>
#include <vector>

namespace pedicel::plots {

/// Values over rows with names and an axis: each cell is filled by the level that it reaches.
struct HeatMap {
  std::string title;
  std::string x_label;  ///< with its unit
  std::string value_label;
  std::vector<std::string> rows;           ///< names, the first one at the top
  std::vector<double> edges;               ///< of the columns, one more than there are; ascending
  std::vector<std::vector<double>> value;  ///< [row][column]; NaN: nothing there
  std::vector<double> levels;              ///< ascending: below the first is paper-white
  int width = 640;                         ///< px; the height follows from the rows
};

/// One <svg> element, light theme, as to_svg() of the plots; the legend with the levels stands
/// above the map. Throws UsageError where the sizes of the table do not fit or it is narrower than
/// 300 px.
std::string to_svg(const HeatMap& map);

}  // namespace pedicel::plots
