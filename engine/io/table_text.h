#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/number_text.h"
#include "engine/io/table_records.h"

/// Tables as people and their programs write them, cell by cell. Everything here finds one meaning
/// or says that there are two: nothing is guessed.
namespace pedicel::io {

/// The most that is read of one table, so that no file fills the memory.
constexpr std::size_t most_columns = 10000;
constexpr std::size_t most_rows = 4000000;
constexpr std::size_t most_cells = 20000000;

/// How a table is written.
struct TableDialect {
  char separator = ',';  ///< , ; tab | or ' ' for any number of blanks
  NumberStyle numbers;
};

/// "a comma", "a semicolon", ... for a sentence.
std::string name_of_separator(char separator);

/// "unit: cm" in a comment: of all lengths of a file. `text` is empty where there is none.
struct StatedUnit {
  std::string text;
  int line = 0;
};

/// What a comment line says of the unit; empty where it is about something else.
std::string unit_in_comment(std::string_view comment);

/// A column as the header has it.
struct TableColumn {
  std::string name;  ///< as written, without quotes
  std::string unit;  ///< from a row of units below the header; empty where there is none
  int column = 1;    ///< where the name begins in its line
};

/// A table with a header line, read row by row. Separators , ; tab | or blanks, found from the
/// header and the first rows; decimal commas where no comma parts the cells; quotes; comment lines
/// (#, % and
/// //); blank lines; rows of empty cells; separators behind the last cell; "sep=;" in the
/// first line; names in a comment line above rows that have no header; a row of units below the
/// header; numbers of rows without a name before them, as R and pandas write them, which are passed
/// over. Line and column of every fault go to the diagnostics.
class TableText {
 public:
  /// `text` as read_text_file() gives it; both outlive the table.
  TableText(std::string_view text, std::string file, Diagnostics& diagnostics);

  /// False where the header or the way of writing cannot be told; that is said then.
  bool good() const { return good_; }
  const std::string& file() const { return file_; }
  const std::vector<TableColumn>& columns() const { return columns_; }
  int header_line() const { return header_line_; }
  const TableDialect& dialect() const { return dialect_; }
  /// The unit that a comment line above the header states for the whole table ("# unit: cm").
  const StatedUnit& stated_unit() const { return stated_unit_; }

  /// The next row with as many cells as the header has names; rows with another number of them are
  /// reported and passed over. False at the end, and where the table is too large.
  bool next();
  const std::vector<TableCell>& cells() const { return *cells_; }
  int line() const { return line_; }
  SourcePosition at(std::size_t column) const;

  /// Reports a fault of a column's cell in this row; the same `kind` of fault further on, in this
  /// column or another, is counted.
  void cell_error(std::size_t column, std::string_view kind, const std::string& what);
  /// The number in a cell, reported where there is none; missing ones are reported as well unless
  /// `gaps` allows them, and then are NaN.
  double number(std::size_t column, bool gaps);

 private:
  void find_header();
  bool names_in_comment(std::string_view comment, int line);
  void take_header(const std::vector<TableCell>& cells, int line);
  void take_units();
  void find_decimal_mark();
  void find_row_numbers();
  bool pass_over(std::string_view record) const;
  /// The cells of a record, without the row's number where rows have one.
  const std::vector<TableCell>& split(std::string_view record);
  bool is_header_again() const;
  void wrong_number_of_cells(std::size_t found);
  void error(int line, int column, std::string what);

  std::string file_;
  Diagnostics& diagnostics_;
  RecordScanner scanner_;
  CellSplitter splitter_{','};
  TableDialect dialect_;
  std::vector<TableColumn> columns_;
  StatedUnit stated_unit_;
  const std::vector<TableCell>* cells_ = nullptr;
  std::vector<TableCell> own_cells_;  ///< of a record without its number
  bool row_numbers_ = false;          ///< rows begin with a number of their own
  std::size_t rows_ = 0;
  int header_line_ = 0, line_ = 0;
  bool good_ = false;
};

}  // namespace pedicel::io
