#include "plugins/discrepancy/import/headed_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/table_dialect.h"
#include "engine/io/table_text.h"

namespace pedicel::discrepancy {

HeadedTable::HeadedTable(std::string_view text, const std::string& file, char separator,
                         Diagnostics& diagnostics)
    : scanner_(text),
      splitter_(separator),
      file_(file),
      diagnostics_(diagnostics),
      cells_(&splitter_.split({})) {}

bool HeadedTable::next_line() {
  if (!scanner_.next()) return false;
  cells_ = &splitter_.split(scanner_.record());
  return true;
}

bool HeadedTable::next() {
  while (next_line())
    if (!is_empty()) return true;
  return false;
}

bool HeadedTable::is_empty() const {
  return std::ranges::all_of(*cells_, [](const io::TableCell& cell) { return cell.text.empty(); });
}

std::string_view HeadedTable::cell(std::size_t column) const {
  return column < cells_->size() ? (*cells_)[column].text : std::string_view();
}

SourcePosition HeadedTable::at(std::size_t column) const {
  return {file_, scanner_.line(), column < cells_->size() ? (*cells_)[column].column : 1};
}

bool HeadedTable::find_decimal_mark() {
  const io::DecimalFound found =
      io::find_decimal(scanner_.rest(), scanner_.next_line(), splitter_.separator());
  style_.decimal = found.decimal;
  if (found.fault.empty()) return true;
  diagnostics_.error({file_, found.line, found.column}, found.fault);
  return false;
}

bool HeadedTable::is_number(std::size_t column) const {
  return io::number_of(cell(column), style_).kind == io::NumberText::Kind::number;
}

double HeadedTable::number(std::size_t column, bool needed) {
  const std::string_view text = cell(column);
  const io::NumberText found = io::number_of(text, style_);
  if (found.kind == io::NumberText::Kind::number) return found.value;
  if (found.kind != io::NumberText::Kind::missing || needed) {
    const std::string why = io::why_no_number(text, style_);
    diagnostics_.repeated_error(why, at(column), in_quotes(text) + " " + why);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> HeadedTable::point(std::initializer_list<std::size_t> columns) {
  std::vector<double> axes;
  for (const std::size_t column : columns) axes.push_back(number(column));
  const auto missing = std::ranges::count_if(axes, [](double x) { return std::isnan(x); });
  if (missing > 0 && missing < static_cast<std::ptrdiff_t>(axes.size()))
    diagnostics_.repeated_error("half a point", at(*columns.begin()),
                                "a point has some of its axes, expected all of them or none");
  if (missing > 0) axes.assign(axes.size(), std::numeric_limits<double>::quiet_NaN());
  return axes;
}

bool HeadedTable::count_row(std::size_t columns) {
  counted_ += columns;
  if (columns <= io::most_columns && counted_ <= io::most_cells) return true;
  error(0, "the table goes on, expected at most " + std::to_string(io::most_columns) +
               " columns and " + std::to_string(io::most_cells) + " cells");
  return false;
}

void HeadedTable::error(std::size_t column, const std::string& what) {
  diagnostics_.error(at(column), what);
}

char separator_behind(std::string_view text, std::string_view key) {
  constexpr std::string_view separators = ",;\t";
  if (text.size() <= key.size() || !text.starts_with(key)) return '\0';
  return separators.find(text[key.size()]) == std::string_view::npos ? '\0' : text[key.size()];
}

}  // namespace pedicel::discrepancy
