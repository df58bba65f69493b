#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/table_text.h"
#include "engine/io/unit_text.h"

/// Tables whose columns are known: what each is called and measures, and which are needed.
namespace pedicel::io {

/// A column that a table may have.
struct ColumnSpec {
  std::string name;
  std::optional<Quantity> quantity = Quantity::none;  ///< nothing: it holds texts
};

/// Which of its columns a table must have.
enum class NeededColumns {
  all,
  points,  ///< of each three, a point's axes, one or more
  any,     ///< one or more
  none
};

/// What a table holds. Columns stand in any order and are named as programs name them: with other
/// capitals, with a unit behind ("m1.x (mm)", "m1.x_mm") and with other marks within ("M1_X").
/// Names as they are written come first, and a name that fits two columns fits none.
struct TableSpec {
  static constexpr std::size_t every = std::numeric_limits<std::size_t>::max();

  std::vector<ColumnSpec> columns = {};
  std::string expected = {};  ///< all of them in a sentence, for errors
  NeededColumns needed = NeededColumns::all;
  std::size_t needed_first = every;  ///< the columns behind so many are all there or none is
  bool gaps = true;                  ///< numbers may be missing, but for the time's
  bool whole_points = false;         ///< a row has all axes of a point that have columns or none
  bool needs_rows = true;

  struct Time {
    bool there = true;        ///< else the rows have none, and one that is there is not read
    bool needs_unit = false;  ///< "time_s" and not "time"
    bool increasing = true;   ///< strictly
    bool from_zero = true;    ///< not negative
  } time = {};
};

/// Reads such a table row by row, everything in SI units, whatever unit the header or a row of
/// units says. Columns that count the rows are told and passed over. Every fault goes to the
/// diagnostics with its line and column; where the header has one no rows come.
class SpecTable {
 public:
  SpecTable(const std::filesystem::path& file, TableSpec spec, Diagnostics& diagnostics);
  SpecTable(const SpecTable&) = delete;

  /// Nothing was wrong so far.
  bool good() const { return diagnostics_.error_count() == before_; }
  /// Whether the table has a column of the spec.
  bool has(std::size_t column) const { return columns_[column].at >= 0; }
  bool next();
  /// s; without a time the number of the row, from 0.
  double time() const { return time_; }
  /// NaN where it is missing.
  double value(std::size_t column) const { return columns_[column].value; }
  std::string text(std::size_t column) const;
  /// An error of a column of the spec: of its name, or of its cell in this row. The same `kind` in
  /// row after row is said once.
  void name_error(std::size_t column, const std::string& what);
  void row_error(std::string_view kind, std::size_t column, const std::string& what);

 private:
  struct Column {
    int at = -1;  ///< index in the table, -1: not there
    double factor = 1.0, value = std::numeric_limits<double>::quiet_NaN();
  };
  /// A column that nobody expects and that is named like one that counts the rows.
  struct Counter {
    std::size_t at;
    double last;
    bool counts;
  };

  void find_columns();
  bool find_time();
  void say_differences(const std::vector<std::size_t>& unknown);
  std::vector<std::string> missing() const;
  void set_unit(Column& column, std::size_t at, std::string said, Quantity quantity);
  void error_at(std::size_t at, const std::string& what);
  void take_time();
  void count();
  void check_points();
  void end();

  TableSpec spec_;
  Diagnostics& diagnostics_;
  int before_;
  std::string content_;
  std::optional<TableText> table_;
  std::vector<Column> columns_;
  Column time_column_;
  std::vector<Counter> counters_;
  std::size_t rows_ = 0;
  double time_ = 0.0;
  bool ends_ = false;
};

}  // namespace pedicel::io
