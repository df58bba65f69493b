#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::io {

/// A table of numbers with one header line, in any of the ways of writing that TableText takes.
struct CsvTable {
  std::string file;
  std::vector<std::string> columns;       ///< names as written, with the unit where it has one
  std::vector<std::vector<double>> rows;  ///< row major; NaN where a cell is empty
  std::vector<int> lines;                 ///< line number of each row in the file
  int header_line = 0;                    ///< line number of the column names

  /// Index of a column, -1 where absent.
  int column(const std::string& name) const;
};

/// Whether a heading names a column, whatever its capitals, with or without a unit behind it ("Time
/// (s)", "m1.x_mm"), and that unit.
struct ColumnMatch {
  bool matches = false;
  std::string unit;  ///< empty where none is said
};
ColumnMatch match_column(const std::string& heading, const std::string& name);

/// What read_csv() accepts beyond plain finite numbers.
struct CsvRules {
  bool empty_cells = false;      ///< a cell may be missing: empty, nan, NA, null, -
  bool increasing_first = true;  ///< the first column (time) must increase strictly
};

/// Reads a table. Every fault (wrong number of cells, not a number, time that does not increase)
/// goes to `diagnostics` with its line and column; then the table comes back empty.
CsvTable read_csv(const std::filesystem::path& path, const CsvRules& rules,
                  Diagnostics& diagnostics);

/// Appends rows to a CSV file, flushed often, so that a run that is stopped leaves readable output.
/// Numbers have 9 significant digits; NaN is written as "nan".
class CsvWriter {
 public:
  /// Columns carry their unit in the name ("force_x_N"). Throws WriteError.
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns);

  void row(std::span<const double> values);
  /// A row whose cells are already text (events).
  void text_row(const std::vector<std::string>& cells);
  void flush();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
  std::size_t columns_;
};

/// A number as it is written in our CSV and YAML files: shortest of 9 significant digits.
std::string format_number(double value, int digits = 9);

/// The shortest text that reads back as the same number; empty for NaN, which is how a table
/// says that nothing was measured.
std::string exact_number(double value);

}  // namespace pedicel::io
