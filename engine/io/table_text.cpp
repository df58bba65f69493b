#include "engine/io/table_text.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/io/table_dialect.h"
#include "engine/io/text_file.h"
#include "engine/io/unit_text.h"

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
    // "1" is how a number without a unit is written; alone it is a number.
    if (cell.text.empty() || cell.text == "-" || cell.text == "1") continue;
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
  find_row_numbers();
  take_units();
  find_decimal_mark();
}

void TableText::error(int line, int column, std::string what) {
  diagnostics_.error({file_, line, column}, std::move(what));
}

bool TableText::pass_over(std::string_view record) const {
  return is_blank(record) || is_comment(record) || is_rule(record);
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
    found = !pass_over(scanner_.record()) && !is_comment_above_header(scanner_.record());
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

// Numbers of the rows, which say nothing: below no name (pandas, R's write.csv), or before as many
// cells as there are names, in quotes as no other cell is (R's write.table). A column without a
// name and without a cell is no column either.
void TableText::find_row_numbers() {
  const std::string_view first = columns_.empty() ? std::string_view() : columns_.front().name;
  const bool unnamed = columns_.size() > 1 && (first.empty() || first == "Unnamed: 0");
  std::size_t rows = 0;
  bool count = true, empty = true, before = true;
  double next = 0.0;
  for (RecordScanner ahead = scanner_; rows < first_rows && ahead.next();) {
    if (pass_over(ahead.record())) continue;
    const auto& cells = splitter_.split(ahead.record());
    const NumberText number = number_of(cells.front().text);
    count = count && number.kind == NumberText::Kind::number &&
            (rows == 0 ? number.value == 0.0 || number.value == 1.0 : number.value == next);
    next = number.value + 1.0;
    empty = empty && cells.front().text.empty();
    before = before && said(cells) == columns_.size() + 1 && has_row_name(ahead.record());
    ++rows;
  }
  if (rows == 0) return;
  row_numbers_ = before || (unnamed && (count || empty));
  if (!row_numbers_ || before) return;
  if (count)
    diagnostics_.notice({file_, header_line_, columns_.front().column},
                        "the first column has no name and counts the rows: it is not read");
  columns_.erase(columns_.begin());
}

const std::vector<TableCell>& TableText::split(std::string_view record) {
  const auto& cells = splitter_.split(record);
  if (!row_numbers_) return cells;
  own_cells_.assign(cells.begin() + 1, cells.end());
  return own_cells_;
}

bool TableText::is_header_again() const {
  return std::equal(
      columns_.begin(), columns_.end(), cells_->begin(),
      [](const TableColumn& column, const TableCell& cell) { return column.name == cell.text; });
}

void TableText::take_units() {
  RecordScanner ahead = scanner_;
  while (ahead.next() && pass_over(ahead.record())) {
  }
  if (ahead.line() == 0 || pass_over(ahead.record())) return;
  const auto& cells = split(ahead.record());
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
    cells_ = &split(scanner_.record());
    const std::size_t there = said(*cells_);
    if (there == 0) continue;
    if (cells_->size() < columns_.size() || there > columns_.size()) {
      wrong_number_of_cells(cells_->size());
      continue;
    }
    if (is_header_again()) {
      diagnostics_.repeated_error("header", at(0),
                                  "the names of the columns again, expected one table in a file");
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
  const std::size_t before = row_numbers_ ? 1 : 0;
  std::string what = std::to_string(found + before) + " cells, expected " +
                     std::to_string(columns_.size() + before) + " as in the header";
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

void TableText::cell_error(std::size_t column, std::string_view kind, const std::string& what) {
  const std::string& name = columns_[column].name;
  diagnostics_.repeated_error(
      kind, at(column),
      (name.empty() ? "column " + std::to_string(column + 1) : printable(name, 60)) + ": " + what);
}

double TableText::number(std::size_t column, bool gaps) {
  const std::string_view text = (*cells_)[column].text;
  const NumberText found = number_of(text, dialect_.numbers);
  if (found.kind == NumberText::Kind::number) return found.value;
  if (found.kind != NumberText::Kind::missing || !gaps) {
    const std::string why = why_no_number(text, dialect_.numbers);
    cell_error(column, why, in_quotes(text) + " " + why);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace pedicel::io
