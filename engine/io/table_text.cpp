#include "io/table_text.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/table_dialect.h"
#include "io/text_file.h"
#include "io/unit_text.h"

namespace pedicel::io {

namespace {

constexpr std::size_t first_rows = 20;  ///< that the separator is told from

bool is_number(std::string_view text) {
  for (const char decimal : {'.', ','})
    if (number_of(text, {decimal}).kind == NumberText::Kind::number) return true;
  return false;
}

std::size_t said(const std::vector<TableCell>& cells) {
  std::size_t count = cells.size();
  while (count > 0 && cells[count - 1].text.empty()) --count;
  return count;
}

// "sep=;", with which Excel is told what parts the cells.
char stated_separator(std::string_view record) {
  if (record.size() != 5 || !same_but_case(record.substr(0, 4), "sep=")) return '\0';
  return record.back();
}

bool is_row_of_units(const std::vector<TableCell>& cells) {
  bool any = false;
  for (const TableCell& cell : cells) {
    if (cell.text.empty() || cell.text == "-") continue;
    if (is_number(cell.text)) return false;
    if (within_brackets(cell.text).empty() && cell.text != "()" && cell.text != "[]" &&
        !unit_of(cell.text))
      return false;
    any = true;
  }
  return any;
}

}  // namespace

std::string unit_in_comment(std::string_view comment) {
  const std::size_t start = comment.find_first_not_of("#% \t");
  if (start == std::string_view::npos) return {};
  std::string_view text = comment.substr(start);
  for (const std::string_view word : {"units", "unit"}) {
    if (!same_but_case(text.substr(0, word.size()), word)) continue;
    text.remove_prefix(word.size());
    const std::size_t mark = text.find_first_not_of(" \t");
    if (mark == std::string_view::npos || (text[mark] != ':' && text[mark] != '=')) return {};
    text.remove_prefix(mark + 1);
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r,;") - first + 1));
  }
  return {};
}

TableText::TableText(std::string_view text, std::string file, Diagnostics& diagnostics)
    : file_(std::move(file)), diagnostics_(diagnostics), scanner_(without_mark(text)) {
  find_header();
  if (!good_) return;
  take_units();
  find_decimal_mark();
}

void TableText::error(int line, int column, std::string what) {
  diagnostics_.error({file_, line, column}, std::move(what));
}

bool TableText::pass_over(std::string_view record) const {
  return is_blank(record) || is_comment(record);
}

void TableText::find_header() {
  std::string_view comment;
  int comment_line = 0;
  char stated = '\0';
  bool found = false;
  while (!found && scanner_.next()) {
    if (scanner_.line() == 1 && (stated = stated_separator(scanner_.record())) != '\0') continue;
    if (is_comment(scanner_.record())) {
      comment = scanner_.record();
      comment_line = scanner_.line();
      if (const std::string unit = unit_in_comment(comment); !unit.empty())
        stated_unit_ = {unit, comment_line};
    }
    found = !pass_over(scanner_.record());
  }
  if (!found) return error(1, 1, "no header line, expected column names");
  const TableLine header{scanner_.record(), scanner_.line()};
  std::vector<TableLine> rows;
  // Copied, so that the rows are there again for next().
  for (RecordScanner ahead = scanner_; rows.size() < first_rows && ahead.next();)
    if (!pass_over(ahead.record())) rows.push_back({ahead.record(), ahead.line()});
  SeparatorFound separator = find_separator(header, rows);
  if (stated != '\0') separator = {stated, {}, 0};
  if (!separator.fault.empty()) return error(separator.line, 1, separator.fault);
  dialect_.separator = separator.separator;
  splitter_ = CellSplitter(dialect_.separator);
  const auto& cells = splitter_.split(header.text);
  if (cells.size() > most_columns)
    return error(header.line, 1,
                 std::to_string(cells.size()) + " columns, expected at most " +
                     std::to_string(most_columns));
  const bool numbers = std::all_of(cells.begin(), cells.end(), [](const TableCell& cell) {
    return cell.text.empty() || is_number(cell.text);
  });
  good_ = true;
  if (!numbers) return take_header(cells, header.line);
  good_ = names_in_comment(comment, comment_line);
  if (!good_)
    error(header.line, 1, "no header line, expected column names before the first numbers");
}

// The line of numbers is read again, as the first row.
bool TableText::names_in_comment(std::string_view comment, int line) {
  const std::size_t mark = comment.find_first_of("#%");
  if (mark == std::string_view::npos) return false;
  const std::size_t expected = splitter_.split(scanner_.record()).size();
  const std::size_t start = comment.find_first_not_of("#% \t", mark);
  if (start == std::string_view::npos) return false;
  const auto& cells = splitter_.split(comment.substr(start));
  if (cells.size() != expected) return false;
  take_header(cells, line);
  for (TableColumn& column : columns_) column.column += static_cast<int>(start);
  scanner_.again();
  return true;
}

void TableText::take_header(const std::vector<TableCell>& cells, int line) {
  header_line_ = line;
  const std::size_t names = said(cells);
  for (std::size_t i = 0; i < names; ++i)
    columns_.push_back({std::string(cells[i].text), {}, cells[i].column});
}

void TableText::take_units() {
  RecordScanner ahead = scanner_;
  while (ahead.next() && pass_over(ahead.record())) {
  }
  if (ahead.line() == 0 || pass_over(ahead.record())) return;
  const auto& cells = splitter_.split(ahead.record());
  if (cells.size() < columns_.size() || !is_row_of_units(cells)) return;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string_view within = within_brackets(cells[i].text);
    columns_[i].unit = within.empty() ? cells[i].text : within;
    if (columns_[i].unit == "-" || columns_[i].unit == "()" || columns_[i].unit == "[]")
      columns_[i].unit.clear();
  }
  scanner_ = ahead;
}

void TableText::find_decimal_mark() {
  const DecimalFound found =
      find_decimal(scanner_.rest(), scanner_.next_line(), dialect_.separator);
  dialect_.numbers.decimal = found.decimal;
  if (found.fault.empty()) return;
  good_ = false;
  error(found.line, found.column, found.fault);
}

bool TableText::next() {
  while (good_ && scanner_.next()) {
    if (pass_over(scanner_.record())) continue;
    line_ = scanner_.line();
    if (scanner_.open_quote()) {
      diagnostics_.repeated_error("quote", {file_, line_, 1},
                                  "a quote opens and is never closed, expected one more \"");
      continue;
    }
    cells_ = &splitter_.split(scanner_.record());
    const std::size_t there = said(*cells_);
    if (there == 0) continue;
    if (cells_->size() < columns_.size() || there > columns_.size()) {
      wrong_number_of_cells(cells_->size());
      continue;
    }
    if (++rows_ > most_rows || rows_ * columns_.size() > most_cells) {
      good_ = false;
      error(line_, 1,
            "the table goes on, expected at most " +
                std::to_string(std::min(most_rows, most_cells / columns_.size())) + " rows of " +
                std::to_string(columns_.size()) + " cells");
      return false;
    }
    return true;
  }
  return false;
}

void TableText::wrong_number_of_cells(std::size_t found) {
  std::string what = std::to_string(found) + " cells, expected " + std::to_string(columns_.size()) +
                     " as in the header";
  // Decimal commas leave digits alone in every cell.
  const bool digits = std::all_of(cells_->begin(), cells_->end(), [](const TableCell& cell) {
    return cell.text.find_first_not_of("+-0123456789") == std::string_view::npos;
  });
  if (dialect_.separator == ',' && digits && found > columns_.size())
    what += " (decimal commas? part the columns by ; or write decimal points)";
  diagnostics_.repeated_error("cells", {file_, line_, 1}, what);
}

SourcePosition TableText::at(std::size_t column) const {
  return {file_, line_, (*cells_)[column].column};
}

void TableText::cell_error(std::size_t column, const std::string& what) {
  diagnostics_.repeated_error("column " + std::to_string(column), at(column),
                              printable(columns_[column].name, 60) + ": " + what);
}

double TableText::number(std::size_t column, bool gaps) {
  const std::string_view text = (*cells_)[column].text;
  const NumberText found = number_of(text, dialect_.numbers);
  if (found.kind == NumberText::Kind::number) return found.value;
  if (found.kind != NumberText::Kind::missing || !gaps)
    cell_error(column, in_quotes(text) + " " + why_no_number(text, dialect_.numbers));
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace pedicel::io
