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
#include "engine/io/unit_text.h"

namespace pedicel::io {

namespace {

void take_row(TableText& source, const CsvRules& rules, CsvTable& table, Diagnostics& diagnostics) {
  std::vector<double> row(table.columns.size());
  for (std::size_t i = 0; i < row.size(); ++i)
    row[i] = source.number(i, rules.empty_cells && !(i == 0 && rules.increasing_first));
  if (rules.increasing_first && !table.rows.empty() && row[0] <= table.rows.back()[0])
    diagnostics.repeated_error("increase", source.at(0),
                               table.columns[0] + " " + format_number(row[0]) +
                                   " does not increase, expected more than " +
                                   format_number(table.rows.back()[0]));
  table.rows.push_back(std::move(row));
  table.lines.push_back(source.line());
}

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

CsvTable read_csv(const std::filesystem::path& path, const CsvRules& rules,
                  Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  CsvTable table;
  try {
    const std::string text = read_text_file(path);
    TableText source(text, path.string(), diagnostics);
    table.file = source.file();
    table.header_line = source.header_line();
    for (const TableColumn& column : source.columns()) table.columns.push_back(column.name);
    while (source.next()) take_row(source, rules, table, diagnostics);
    if (table.rows.empty() && diagnostics.error_count() == before)
      diagnostics.error({table.file, table.header_line, 1},
                        "no rows, expected at least one row of numbers");
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
