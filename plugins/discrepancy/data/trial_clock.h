#pragma once

#include <filesystem>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// The times of one table of a trial.
struct TableClock {
  std::filesystem::path file;                  ///< in the trial's folder
  double first = 0.0, last = 0.0, step = 0.0;  ///< s; step: the median
  int rows = 0;

  double span() const { return last - first; }
};

TableClock clock_of(const std::filesystem::path& file, const std::vector<double>& time);

/// Of every table that has rows: markers.csv first, then force.csv and the paths.
std::vector<TableClock> clocks_of(const Trial& trial);

/// When something is done in a trial (s). A path that does not move does nothing.
struct DriveTimes {
  double first = 0.0, last = 0.0;
  bool any = false;
  bool over = false;  ///< after `last` nothing acts any more, and nothing is held
};
DriveTimes drive_times(const Trial& trial);

}  // namespace pedicel::discrepancy
