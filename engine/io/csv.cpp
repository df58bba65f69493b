#include "engine/io/csv.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv_cell.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"

namespace pedicel::io {

namespace {

/// Takes a table's rows as numbers.
class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const CsvRules& rules,
         Diagnostics& diagnostics)
      : source_(text, file, diagnostics), rules_(rules), diagnostics_(diagnostics) {}

  CsvTable read() {
    if (!source_.good()) return {};
    table_.file = source_.file();
    table_.header_line = source_.header_line();
    table_.separator = source_.dialect().separator;
    for (const TableColumn& column : source_.columns()) {
      table_.columns.push_back(column.name);
      table_.units.push_back(column.unit);
    }
    const int before = diagnostics_.error_count();
    while (source_.next()) take_row();
    if (table_.rows.empty() && diagnostics_.error_count() == before)
      diagnostics_.error({table_.file, table_.header_line, 1},
                         "no rows, expected at least one row of numbers");
    return std::move(table_);
  }

 private:
  void take_row() {
    std::vector<double> row(table_.columns.size());
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = source_.number(i, rules_.empty_cells && !(i == 0 && rules_.increasing_first));
    if (rules_.increasing_first && !table_.rows.empty() && row[0] <= table_.rows.back()[0])
      diagnostics_.repeated_error("increase", source_.at(0),
                                  table_.columns[0] + " " + format_number(row[0]) +
                                      " does not increase, expected more than " +
                                      format_number(table_.rows.back()[0]));
    table_.rows.push_back(std::move(row));
    table_.lines.push_back(source_.line());
  }

  TableText source_;
  CsvTable table_;
  CsvRules rules_;
  Diagnostics& diagnostics_;
};

}  // namespace

int CsvTable::column(const std::string& name) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == name) return static_cast<int>(i);
  return -1;
}

ColumnMatch match_column(const std::string& heading, const std::string& name) {
  const NamedUnit named = split_unit(heading);
  if (same_but_case(named.name, name)) return {true, named.unit};
  if (unit_behind(heading, name)) return {true, heading.substr(name.size() + 1)};
  return {};
}

bool to_si(CsvTable& table, int column, const std::string& name, Quantity quantity,
           Diagnostics& diagnostics) {
  const std::string said = match_column(table.columns[column], name).unit;
  const std::string& row = table.units[column];
  const auto refuse = [&](const std::string& what) {
    diagnostics.error(cell_position(table, table.header_line, column),
                      "column " + in_quotes(table.columns[column]) + " " + what);
    return false;
  };
  const std::string& text = said.empty() ? row : said;
  if (text.empty()) return true;
  const std::optional<Unit> unit = unit_of(text);
  if (!unit || (unit->quantity != quantity && unit->quantity != Quantity::none))
    return refuse("is in " + in_quotes(text) + ", expected " + units_of(quantity));
  const std::optional<Unit> other = row.empty() ? unit : unit_of(row);
  if (!other || other->factor != unit->factor || other->quantity != unit->quantity)
    return refuse("has " + in_quotes(row) + " below it, expected one unit");
  if (unit->factor != 1.0)
    for (std::vector<double>& values : table.rows) values[column] *= unit->factor;
  return true;
}

SourcePosition cell_position(const CsvTable& table, int line, int column) {
  try {
    const std::string text = read_text_file(table.file);
    RecordScanner scanner(text);
    while (scanner.next() && scanner.line() < line) {
    }
    CellSplitter splitter(table.separator);
    const auto& cells = splitter.split(scanner.record());
    Diagnostics unused;
    const TableText source(text, table.file, unused);
    const int cell = column + (line == table.header_line ? source.cells_before_header()
                                                         : source.cells_before_rows());
    const bool known =
        scanner.line() == line && column >= 0 && static_cast<std::size_t>(cell) < cells.size();
    return {table.file, line, known ? cells[cell].column : 1};
  } catch (const InvalidFile&) {
    return {table.file, line, 1};
  }
}

CsvTable read_csv(const std::filesystem::path& path, const CsvRules& rules,
                  Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  CsvTable table;
  try {
    const std::string text = read_text_file(path);
    table = Reader(text, path.string(), rules, diagnostics).read();
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  if (diagnostics.error_count() > before) return {};
  return table;
}

std::string format_number(double value, int digits) {
  if (std::isnan(value)) return "nan";
  char text[40];
  const auto [end, error] =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  PEDICEL_ASSERT(error == std::errc{});
  return std::string(text, end);
}

std::string exact_number(double value) {
  if (std::isnan(value)) return {};
  char text[40];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  PEDICEL_ASSERT(error == std::errc{});
  return std::string(text, end);
}

namespace {

/// A full disk takes a row in part: the rows before it stay, and an empty file goes.
void keep_whole_rows(const std::filesystem::path& path) {
  std::error_code error;
  std::string text;
  if (!std::filesystem::is_regular_file(path, error)) return;
  try {
    text = read_file(path);
  } catch (const InvalidFile&) {
    return;
  }
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos)
    std::filesystem::remove(path, error);
  else
    std::filesystem::resize_file(path, end + 1, error);
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw WriteError(path.string() + ": cannot be written: " + error.message());
  file_.open(path, std::ios::trunc);
  if (!file_) throw WriteError(path.string() + ": cannot be written: " + std::strerror(errno));
  text_row(columns);
  flush();
}

void CsvWriter::row(std::span<const double> values) {
  std::vector<std::string> cells;
  for (const double value : values) cells.push_back(format_number(value));
  text_row(cells);
}

// In one piece, which goes to the file in one piece: who is killed leaves whole rows.
void CsvWriter::text_row(const std::vector<std::string>& cells) {
  PEDICEL_ASSERT(cells.size() == columns_);
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row += (i ? "," : "") + csv_cell(cells[i]);
  file_ << row + '\n';
}

void CsvWriter::flush() {
  if (file_.flush()) return;
  const std::string reason = std::strerror(errno);
  file_.close();
  keep_whole_rows(path_);
  throw WriteError(path_.string() + ": cannot be written: " + reason);
}

}  // namespace pedicel::io
