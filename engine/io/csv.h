#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostics.h"

namespace pedicel::io {

/// A table of numbers with one header line. Comma separated, '.' decimal whatever the locale. Lines
/// that start with '#' and blank lines are skipped.
struct CsvTable {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< row major; NaN where a cell is empty
  std::vector<int> lines;                 ///< line number of each row in the file
  int header_line = 0;                    ///< line number of the column names

  /// Index of a column, -1 where absent.
  int column(const std::string& name) const;
};

/// Where a cell stands: `line` as in `lines` or `header_line`, `column` its index. The file is read
/// again for it, so it is for errors only.
SourcePosition cell_position(const CsvTable& table, int line, int column);

/// What read_csv() accepts beyond plain finite numbers.
struct CsvRules {
  bool empty_cells = false;      ///< an empty cell or "nan" is a missing value
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
