#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/number_text.h"
#include "engine/io/table_records.h"
#include "plugins/discrepancy/data/experiment_tables.h"

namespace pedicel::discrepancy {

/// The lines of a table whose head has several of them, cell by cell. Lines without any cell are
/// passed over unless they are asked for.
class HeadedTable {
 public:
  /// `text` and the diagnostics outlive the table.
  HeadedTable(std::string_view text, const std::string& file, char separator,
              Diagnostics& diagnostics);

  /// The next line with a cell; false at the end, and where the table is larger than tables may be.
  bool next();
  /// The next line, empty or not.
  bool next_line();
  /// Goes back by one line, which is given again.
  void again() { scanner_.again(); }

  const std::vector<io::TableCell>& cells() const { return *cells_; }
  /// Text of a cell; empty beyond the last one.
  std::string_view cell(std::size_t column) const;
  bool is_empty() const;  ///< every cell is
  int line() const { return scanner_.line(); }
  SourcePosition at(std::size_t column) const;

  /// Tells the decimal mark from the lines that follow; false, with an error, where it cannot.
  bool find_decimal_mark();
  /// The number of a cell; NaN where nothing was measured. What is no number is an error, and a
  /// missing one is where `needed`.
  double number(std::size_t column, bool needed = false);
  /// The numbers of a point's axes, all there or all NaN; half a point, as a row that was cut off
  /// leaves it, is an error.
  std::vector<double> point(std::initializer_list<std::size_t> columns);
  /// Whether a cell has a number.
  bool is_number(std::size_t column) const;
  /// Counts the cells of a row of data; false, with an error, where the table is too large.
  bool count_row(std::size_t columns);

  void error(std::size_t column, const std::string& what);

 private:
  io::RecordScanner scanner_;
  io::CellSplitter splitter_;
  std::string file_;
  Diagnostics& diagnostics_;
  const std::vector<io::TableCell>* cells_;
  io::NumberStyle style_;
  std::size_t counted_ = 0;
};

/// Of a line "key<separator>value...": what parts the cells where it begins with `key`; '\0' where
/// it does not.
char separator_behind(std::string_view text, std::string_view key);

}  // namespace pedicel::discrepancy
