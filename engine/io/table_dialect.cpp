#include "engine/io/table_dialect.h"

#include <algorithm>
#include <array>

#include "engine/io/table_records.h"
#include "engine/io/table_text.h"

namespace pedicel::io {

namespace {

constexpr std::array separators = {',', ';', '\t', '|'};

bool is_number_or_gap(std::string_view text) {
  for (const char decimal : {'.', ','}) {
    const auto kind = number_of(text, {decimal}).kind;
    if (kind == NumberText::Kind::number || kind == NumberText::Kind::missing) return true;
  }
  return false;
}

// Without the empty ones behind the last that says something.
std::size_t cells_of(std::string_view record, char separator) {
  CellSplitter splitter(separator);
  const auto& cells = splitter.split(record);
  std::size_t count = cells.size();
  while (count > 0 && cells[count - 1].text.empty()) --count;
  return count;
}

/// How a separator fits the header and the first rows.
struct Fit {
  std::size_t names = 0;
  bool rows_agree = true;   ///< no row has more cells than names, and one of them as many
  bool all_numbers = true;  ///< of the rows
};

Fit fit_of(char separator, const TableLine& header, const std::vector<TableLine>& rows) {
  Fit fit;
  fit.names = cells_of(header.text, separator);
  CellSplitter splitter(separator);
  std::size_t longest = 0;
  for (const TableLine& row : rows) {
    const std::size_t count = cells_of(row.text, separator);
    longest = std::max(longest, count);
    fit.rows_agree = fit.rows_agree && count <= fit.names && count > 0;
    for (const TableCell& cell : splitter.split(row.text))
      fit.all_numbers = fit.all_numbers && is_number_or_gap(cell.text);
  }
  fit.rows_agree = fit.rows_agree && (rows.empty() || longest > 1);
  return fit;
}

std::vector<char> that(const std::array<Fit, 4>& fits, bool (*holds)(const Fit&)) {
  std::vector<char> found;
  for (std::size_t i = 0; i < separators.size(); ++i)
    if (holds(fits[i])) found.push_back(separators[i]);
  return found;
}

// Names and cells that blanks part, tabs among them; R writes the numbers of the rows before them.
bool fits_blanks(const TableLine& header, const std::vector<TableLine>& rows) {
  const Fit blanks = fit_of(' ', header, rows);
  return blanks.names > 1 && !rows.empty() &&
         std::all_of(rows.begin(), rows.end(), [&](const TableLine& row) {
           const std::size_t count = cells_of(row.text, ' ');
           return count == blanks.names || (count == blanks.names + 1 && has_row_name(row.text));
         });
}

// Header and rows parted by different things, or names that blanks part.
SeparatorFound of_plain_header(const TableLine& header, const std::vector<TableLine>& rows) {
  if (rows.empty()) return {};
  if (fits_blanks(header, rows)) return {' ', {}, 0};
  for (const char separator : separators) {
    const std::size_t count = cells_of(rows.front().text, separator);
    if (count < 2 || separator == ',') continue;
    return {',',
            "the row has " + std::to_string(count) + " cells parted by " +
                name_of_separator(separator) +
                ", the header one name: expected the names of "
                "the columns in the first line, parted alike",
            rows.front().line};
  }
  return {};
}

}  // namespace

bool has_row_name(std::string_view record) {
  const std::size_t open = record.find_first_not_of(" \t");
  if (open == std::string_view::npos || record[open] != '"') return false;
  const std::size_t close = record.find('"', open + 1);
  return close != std::string_view::npos && record.find('"', close + 1) == std::string_view::npos;
}

std::string name_of_separator(char separator) {
  switch (separator) {
    case ',':
      return "commas";
    case ';':
      return "semicolons";
    case '\t':
      return "tabs";
    case '|':
      return "|";
    default:
      return "blanks";
  }
}

SeparatorFound find_separator(const TableLine& header, const std::vector<TableLine>& rows) {
  std::array<Fit, 4> fits;
  for (std::size_t i = 0; i < separators.size(); ++i) fits[i] = fit_of(separators[i], header, rows);
  const auto named = that(fits, [](const Fit& fit) { return fit.names > 1; });
  if (named.empty()) return of_plain_header(header, rows);
  if (named.size() == 1) {
    const char mine = named.front();
    for (const char other : separators)
      if (!rows.empty() && other != mine && cells_of(rows.front().text, mine) == 1 &&
          cells_of(rows.front().text, other) > 1 && !fits_blanks(header, rows))
        return {mine,
                "the row is parted by " + name_of_separator(other) + ", the header by " +
                    name_of_separator(mine) + ": expected both alike",
                rows.front().line};
    const bool by_blanks = mine == '\t' && fits_blanks(header, rows) &&
                           cells_of(rows.front().text, mine) != cells_of(header.text, mine);
    return {by_blanks ? ' ' : mine, {}, 0};
  }
  auto fitting = that(fits, [](const Fit& fit) { return fit.names > 1 && fit.rows_agree; });
  if (fitting.size() > 1)
    fitting = that(
        fits, [](const Fit& fit) { return fit.names > 1 && fit.rows_agree && fit.all_numbers; });
  if (fitting.size() == 1) return {fitting.front(), {}, 0};
  return {',',
          "the header has " + name_of_separator(named[0]) + " and " + name_of_separator(named[1]) +
              ", and the rows do not tell which of them part "
              "the columns: expected one of them",
          header.line};
}

DecimalFound find_decimal(std::string_view rows, int first_line, char separator) {
  if (separator == ',' && rows.find('"') == std::string_view::npos) return {};
  if (rows.find(',') == std::string_view::npos) return {};
  struct Seen {
    int line = 0, column = 0;
    std::string text;
  } comma, point, groups, either;
  const auto note = [](Seen& seen, int line, const TableCell& cell) {
    if (seen.line == 0) seen = {line, cell.column, std::string(cell.text.substr(0, 40))};
  };
  RecordScanner scanner(rows);
  CellSplitter splitter(separator);
  while (scanner.next()) {
    if (is_comment(scanner.record())) continue;
    const int line = first_line + scanner.line() - 1;
    for (const TableCell& cell : splitter.split(scanner.record())) {
      if (has_decimal_point(cell.text)) note(point, line, cell);
      switch (comma_use(cell.text)) {
        case CommaUse::decimal:
          note(comma, line, cell);
          break;
        case CommaUse::groups:
          note(groups, line, cell);
          break;
        case CommaUse::either:
          note(either, line, cell);
          break;
        case CommaUse::none:
          break;
      }
    }
  }
  const Seen& other = point.line > 0 ? point : groups;
  if (comma.line > 0 && other.line > 0)
    return {',',
            in_quotes(comma.text) + " has a decimal comma and " + in_quotes(other.text) +
                " in line " + std::to_string(other.line) +
                " has none: expected one decimal mark in a file",
            comma.line, comma.column};
  if (comma.line > 0) return {',', {}, 0, 1};
  if (either.line > 0 && other.line == 0)
    return {'.',
            in_quotes(either.text) +
                " may be a fraction or have groups of three digits, and no other number "
                "tells: expected a decimal point and no groups",
            either.line, either.column};
  return {};
}

}  // namespace pedicel::io
