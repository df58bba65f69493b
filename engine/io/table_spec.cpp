#include "engine/io/table_spec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/io/csv.h"
#include "engine/io/text_file.h"

namespace pedicel::io {

namespace {

constexpr double missing_value = std::numeric_limits<double>::quiet_NaN();

// Without capitals and without what parts a marker from its axis: m1.x, M1_X, m1:x, "m1 x".
std::string bare(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (std::string_view("._:- ").find(c) == std::string_view::npos)
      out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

struct Match {
  int column = -1;
  std::string unit = {};
};

// As it is written, else whatever its capitals and its unit, else by what parts its name, where
// that is one column's alone.
Match match_of(const std::vector<ColumnSpec>& columns, const std::string& heading) {
  const auto exact = std::ranges::find(columns, heading, &ColumnSpec::name);
  if (exact != columns.end()) return {static_cast<int>(exact - columns.begin())};
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (const ColumnMatch match = match_column(heading, columns[i].name); match.matches)
      return {static_cast<int>(i), match.unit};
  const NamedUnit named = split_unit(heading);
  Match found{-1, named.unit};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (bare(columns[i].name) != bare(named.name)) continue;
    if (found.column >= 0) return {};
    found.column = static_cast<int>(i);
  }
  return found;
}

bool is_named_as_counter(const std::string& heading) {
  constexpr const char* names[] = {"frame",  "frames", "frame#", "frame number", "frame_number",
                                   "sample", "index",  "row",    "no",           "#"};
  return std::ranges::any_of(names, [&](const char* name) { return same_but_case(heading, name); });
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    list += (i > 0 ? ", " : "") + printable(names[i], 60);
  if (names.size() > shown) list += " and " + std::to_string(names.size() - shown) + " more";
  return list;
}

}  // namespace

SpecTable::SpecTable(const std::filesystem::path& file, TableSpec spec, Diagnostics& diagnostics)
    : spec_(std::move(spec)),
      diagnostics_(diagnostics),
      before_(diagnostics.error_count()),
      columns_(spec_.columns.size()) {
  try {
    content_ = read_text_file(file);
    table_.emplace(content_, file.string(), diagnostics);
    if (table_->good() && find_time()) find_columns();
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  ends_ = !good();
}

void SpecTable::error_at(std::size_t at, const std::string& what) {
  diagnostics_.error({table_->file(), table_->header_line(), table_->columns()[at].column}, what);
}

void SpecTable::name_error(std::size_t column, const std::string& what) {
  error_at(static_cast<std::size_t>(columns_[column].at), what);
}

void SpecTable::row_error(std::string_view kind, std::size_t column, const std::string& what) {
  diagnostics_.repeated_error(kind, table_->at(static_cast<std::size_t>(columns_[column].at)),
                              what);
}

std::string SpecTable::text(std::size_t column) const {
  if (!has(column)) return {};
  return std::string(table_->cells()[static_cast<std::size_t>(columns_[column].at)].text);
}

bool SpecTable::find_time() {
  const std::vector<TableColumn>& all = table_->columns();
  for (const char* name : {"time", "t", "timestamp"})
    for (std::size_t c = 0; time_column_.at < 0 && c < all.size(); ++c)
      if (const ColumnMatch match = match_column(all[c].name, name); match.matches) {
        time_column_.at = static_cast<int>(c);
        if (spec_.time.needs_unit && match.unit.empty() && all[c].unit.empty())
          error_at(c, "column " + in_quotes(all[c].name) + " has no unit, expected time_s");
        set_unit(time_column_, c, match.unit, Quantity::time);
      }
  if (time_column_.at < 0 && spec_.time.there)
    error_at(0, "the first column is " + in_quotes(all.front().name) + ", expected " +
                    (spec_.time.needs_unit ? "time_s" : "time") + ", and no other column is it");
  if (time_column_.at >= 0 && !spec_.time.there) {
    const TableColumn& column = all[static_cast<std::size_t>(time_column_.at)];
    diagnostics_.notice({table_->file(), table_->header_line(), column.column},
                        "column " + in_quotes(column.name) +
                            " is not read: the rows of a static series belong together");
  }
  return good();
}

// What stands twice is an error, and units only count where the columns are the right ones.
void SpecTable::find_columns() {
  const std::vector<TableColumn>& all = table_->columns();
  std::vector<std::size_t> unknown;
  std::vector<std::string> units(columns_.size());
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (static_cast<int>(c) == time_column_.at) continue;
    Match match = match_of(spec_.columns, all[c].name);
    if (match.column < 0) {
      if (is_named_as_counter(all[c].name))
        counters_.push_back({c, -std::numeric_limits<double>::infinity(), true});
      else
        unknown.push_back(c);
      continue;
    }
    const auto column = static_cast<std::size_t>(match.column);
    if (has(column))
      error_at(c, "column " + printable(all[c].name, 60) + " appears twice, expected it once");
    columns_[column].at = static_cast<int>(c);
    units[column] = std::move(match.unit);
  }
  if (good()) say_differences(unknown);
  for (std::size_t i = 0; good() && i < columns_.size(); ++i)
    if (has(i) && spec_.columns[i].quantity)
      set_unit(columns_[i], static_cast<std::size_t>(columns_[i].at), units[i],
               *spec_.columns[i].quantity);
}

std::vector<std::string> SpecTable::missing() const {
  const std::size_t first = std::min(spec_.needed_first, columns_.size());
  const auto any = [&](std::size_t begin, std::size_t end) {
    return std::any_of(columns_.begin() + static_cast<std::ptrdiff_t>(begin),
                       columns_.begin() + static_cast<std::ptrdiff_t>(end),
                       [](const Column& column) { return column.at >= 0; });
  };
  if (spec_.needed == NeededColumns::none) return {};
  const std::size_t needed = any(first, columns_.size()) ? columns_.size() : first;
  // How many that belong together one of suffices for.
  const std::size_t together = spec_.needed == NeededColumns::all      ? 1
                               : spec_.needed == NeededColumns::points ? 3
                                                                       : needed;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < needed; i += together)
    if (!any(i, i + together))
      for (std::size_t one = i; one < i + together; ++one) names.push_back(spec_.columns[one].name);
  return names;
}

// In one sentence, where a table has other names altogether.
void SpecTable::say_differences(const std::vector<std::size_t>& unknown) {
  std::vector<std::string> names;
  for (const std::size_t c : unknown) names.push_back(in_quotes(table_->columns()[c].name));
  std::string what;
  if (!names.empty())
    what = names.size() == 1 ? "column " + names.front() + " is unknown"
                             : "columns " + list_of(names) + " are unknown";
  if (const std::vector<std::string> lacking = missing(); !lacking.empty())
    what += (what.empty() ? "no column " : " and there is no ") + list_of(lacking);
  if (!what.empty())
    error_at(unknown.empty() ? 0 : unknown.front(), what + ", expected " + spec_.expected);
}

// By the unit in the name or the one in a row of units; a column without one is in SI units.
void SpecTable::set_unit(Column& column, std::size_t at, std::string said, Quantity quantity) {
  const TableColumn& source = table_->columns()[at];
  const std::string name = "column " + in_quotes(source.name);
  if (said.empty()) said = source.unit;
  if (said.empty()) return;
  const std::optional<Unit> unit = unit_of(said);
  if (!unit || (unit->quantity != quantity && unit->quantity != Quantity::none))
    return error_at(at, name + " is in " + in_quotes(said) + ", expected " + units_of(quantity));
  const std::optional<Unit> other = source.unit.empty() ? unit : unit_of(source.unit);
  if (!other || other->factor != unit->factor || other->quantity != unit->quantity)
    return error_at(at, name + " has " + in_quotes(source.unit) + " below it, expected one unit");
  column.factor = unit->factor;
}

bool SpecTable::next() {
  if (ends_) return false;
  if (!table_->next()) {
    end();
    return false;
  }
  take_time();
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (has(i) && spec_.columns[i].quantity)
      columns_[i].value =
          columns_[i].factor * table_->number(static_cast<std::size_t>(columns_[i].at), spec_.gaps);
  if (spec_.whole_points) check_points();
  count();
  ++rows_;
  return true;
}

void SpecTable::take_time() {
  if (!spec_.time.there) {
    time_ = static_cast<double>(rows_);
    return;
  }
  const auto at = static_cast<std::size_t>(time_column_.at);
  const std::string& name = table_->columns()[at].name;
  const auto error = [&](const char* kind, const std::string& what) {
    diagnostics_.repeated_error(kind, table_->at(at), what);
  };
  const double last = rows_ == 0 ? -std::numeric_limits<double>::infinity() : time_;
  if (number_of(table_->cells()[at].text).kind == NumberText::Kind::missing) {
    time_ = missing_value;
    return error("no time", name + " is empty, expected a time");
  }
  time_ = time_column_.factor * table_->number(at, false);
  if (spec_.time.increasing && time_ <= last)
    error("increase", name + " " + format_number(time_) +
                          " does not increase, expected more than " + format_number(last));
  if (spec_.time.from_zero && time_ < 0.0 && rows_ == 0)
    error("before", "time " + exact_number(time_) + " is before the trial begins, expected >= 0");
}

// Named as cameras name it, and one more in every row or as many more as frames were lost.
void SpecTable::count() {
  for (Counter& counter : counters_) {
    const NumberText number =
        number_of(table_->cells()[counter.at].text, table_->dialect().numbers);
    counter.counts = counter.counts && number.kind == NumberText::Kind::number &&
                     number.value == std::floor(number.value) && number.value > counter.last;
    counter.last = number.value;
  }
}

void SpecTable::check_points() {
  for (std::size_t point = 0; point + 2 < columns_.size(); point += 3) {
    int measured = 0, gaps = 0;
    std::size_t empty = point;
    for (std::size_t axis = point; axis < point + 3; ++axis) {
      if (!has(axis)) continue;
      ++measured;
      // What is no number at all has been told.
      if (!std::isnan(columns_[axis].value) ||
          number_of(text(axis)).kind != NumberText::Kind::missing)
        continue;
      ++gaps;
      empty = axis;
    }
    if (gaps != 0 && gaps != measured)
      row_error("half a point", empty,
                spec_.columns[empty].name +
                    " is empty where the other axes are not, expected all " +
                    (measured == 3 ? "three" : "two") + " or none");
  }
}

void SpecTable::end() {
  ends_ = true;
  if (rows_ == 0 && spec_.needs_rows && good())
    diagnostics_.error({table_->file(), table_->header_line(), 1},
                       "no rows, expected at least one row of numbers");
  for (const Counter& counter : counters_) {
    const TableColumn& column = table_->columns()[counter.at];
    if (!counter.counts)
      error_at(counter.at,
               "column " + in_quotes(column.name) + " is unknown, expected " + spec_.expected);
    else
      diagnostics_.notice({table_->file(), table_->header_line(), column.column},
                          "column " + in_quotes(column.name) + " counts the rows: it is not read");
  }
}

}  // namespace pedicel::io
