#include "io/csv.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

#include "core/check.h"
#include "io/atomic_file.h"

namespace pedicel::io {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

struct Cell {
  std::string_view text;
  int column;  // character column, from 1
};

std::vector<Cell> split(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t start = 0;
  while (true) {
    const std::size_t comma = line.find(',', start);
    const auto raw = line.substr(start, comma == std::string_view::npos ? comma : comma - start);
    cells.push_back({trimmed(raw), static_cast<int>(start) + 1});
    if (comma == std::string_view::npos) return cells;
    start = comma + 1;
  }
}

class Reader {
 public:
  Reader(std::string file, const CsvRules& rules, Diagnostics& diagnostics)
      : rules_(rules), diagnostics_(diagnostics) {
    table_.file = std::move(file);
  }

  CsvTable read(std::string_view text) {
    int line = 0;
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      ++line;
      take(trimmed(text.substr(0, end)).empty() ? std::string_view{} : text.substr(0, end), line);
      text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
    if (table_.columns.empty())
      diagnostics_.error({table_.file, 1, 1}, "no header line, expected column names");
    else if (table_.rows.empty() && !refused_rows_)
      diagnostics_.error({table_.file, line, 1}, "no rows, expected at least one row of numbers");
    return std::move(table_);
  }

 private:
  void take(std::string_view line, int number) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.empty() || line.front() == '#') return;
    const std::vector<Cell> cells = split(line);
    if (table_.columns.empty()) {
      for (const Cell& cell : cells) table_.columns.emplace_back(cell.text);
      table_.header_line = number;
      return;
    }
    if (cells.size() != table_.columns.size()) {
      diagnostics_.error({table_.file, number, 1},
                         std::to_string(cells.size()) + " cells, expected " +
                             std::to_string(table_.columns.size()) + " as in the header");
      refused_rows_ = true;
      return;
    }
    std::vector<double> row;
    for (std::size_t i = 0; i < cells.size(); ++i) row.push_back(value(cells[i], number, i));
    if (rules_.increasing_first && !table_.rows.empty() && !(row[0] > table_.rows.back()[0]))
      diagnostics_.error({table_.file, number, cells[0].column},
                         table_.columns[0] + " " + std::string(cells[0].text) +
                             " does not increase, expected more than " +
                             format_number(table_.rows.back()[0]));
    table_.rows.push_back(std::move(row));
    table_.lines.push_back(number);
  }

  double value(const Cell& cell, int line, std::size_t index) {
    const bool missing = cell.text.empty() || cell.text == "nan";
    if (missing && rules_.empty_cells && !(index == 0 && rules_.increasing_first))
      return std::numeric_limits<double>::quiet_NaN();
    double number = 0.0;
    const char* end = cell.text.data() + cell.text.size();
    const auto [stop, error] = std::from_chars(cell.text.data(), end, number);
    if (cell.text.empty() || error != std::errc{} || stop != end || !std::isfinite(number))
      diagnostics_.error(
          {table_.file, line, cell.column},
          table_.columns[index] + ": \"" + std::string(cell.text) + "\" is not a finite number");
    return number;
  }

  CsvTable table_;
  bool refused_rows_ = false;
  CsvRules rules_;
  Diagnostics& diagnostics_;
};

}  // namespace

int CsvTable::column(const std::string& name) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == name) return static_cast<int>(i);
  return -1;
}

SourcePosition cell_position(const CsvTable& table, int line, int column) {
  std::ifstream file(table.file);
  std::string text;
  for (int i = 0; i < line; ++i) std::getline(file, text);
  const std::vector<Cell> cells = split(text);
  const bool known = file && column >= 0 && column < static_cast<int>(cells.size());
  return {table.file, line, known ? cells[column].column : 1};
}

CsvTable read_csv(const std::filesystem::path& path, const CsvRules& rules,
                  Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  CsvTable table;
  try {
    table = Reader(path.string(), rules, diagnostics).read(read_file(path));
  } catch (const InvalidFile& error) {
    diagnostics.error({path.string()}, "cannot be read");
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

}  // namespace pedicel::io
