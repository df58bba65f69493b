#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/csv.h"

namespace pedicel::app {

/// How far a column of a run's log is from the measured column of its name.
struct ColumnComparison {
  std::string column;
  int samples = 0;       ///< measured values within the run's time
  double largest = 0.0;  ///< in the column's unit
  double rms = 0.0;
  double time = 0.0;  ///< s, of the largest
  bool within = false;
};

/// What `--compare MEASURED.csv --tolerance T` found.
struct Comparison {
  std::filesystem::path measured;
  double tolerance = 0.0;  ///< in each column's own unit
  std::vector<ColumnComparison> columns;
  std::vector<std::string> left_out;  ///< measured columns that the log does not have

  bool within() const;
};

/// Reads a table of measured values: its first column is time_s, a missing value is an empty cell
/// or nan. Throws InvalidFile.
io::CsvTable read_measured(const std::filesystem::path& path);

/// Compares every measured column with the log's of that name, the log taken linearly between its
/// rows. Throws InvalidFile where they have no column and no time in common. `columns` and `rows`
/// as of world::Recorder.
Comparison compare(const io::CsvTable& measured, double tolerance,
                   const std::vector<std::string>& columns,
                   const std::vector<std::vector<double>>& rows);

/// "within  tool_z_m: largest 0.0012 at 2.3 s, rms 0.0004, of 230 samples (tolerance 0.002)"
std::string to_string(const ColumnComparison& column, double tolerance);

}  // namespace pedicel::app
