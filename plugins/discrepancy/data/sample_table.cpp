#include "plugins/discrepancy/data/sample_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/unit_text.h"

namespace pedicel::discrepancy {

namespace {

// Without capitals and without what parts a marker from its axis: m1.x, M1_X, m1:x, "m1 x".
std::string bare(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (std::string_view("._:- ").find(c) == std::string_view::npos)
      out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

// As it is written, else whatever its capitals and its unit, else by what parts its name, where
// that is one column's alone; -1: none.
int index_of_column(const std::vector<std::string>& expected, const std::string& name) {
  const auto exact = std::ranges::find(expected, name);
  if (exact != expected.end()) return static_cast<int>(exact - expected.begin());
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (io::match_column(name, expected[i]).matches) return static_cast<int>(i);
  const std::string alone = bare(io::split_unit(name).name);
  int found = -1;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (bare(expected[i]) != alone) continue;
    if (found >= 0) return -1;
    found = static_cast<int>(i);
  }
  return found;
}

bool is_moment(const std::string& name) {
  return name.size() == 2 && name[0] == 't' && name[1] >= 'x' && name[1] <= 'z';
}

bool is_quaternion(const std::string& name) {
  return name.size() == 2 && name[0] == 'q' && name[1] >= 'w' && name[1] <= 'z';
}

// Of one column in a table of quantities: a quaternion's has no unit, and moments stand by forces.
io::Quantity quantity_of(const std::string& name, io::Quantity table) {
  if (is_quaternion(name)) return io::Quantity::none;
  return table == io::Quantity::force && is_moment(name) ? io::Quantity::moment : table;
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    list += (i > 0 ? ", " : "") + printable(names[i], 60);
  if (names.size() > shown) list += " and " + std::to_string(names.size() - shown) + " more";
  return list;
}

std::vector<std::string> missing_of(const std::vector<std::string>& expected,
                                    const std::vector<int>& found, NeededAxes axes) {
  // How many that belong together one of suffices for.
  const std::size_t together = axes == NeededAxes::all       ? 1
                               : axes == NeededAxes::present ? 3
                                                             : expected.size();
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < expected.size(); i += together) {
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = begin + static_cast<std::ptrdiff_t>(together);
    if (std::any_of(begin, end, [](int column) { return column >= 0; })) continue;
    missing.insert(missing.end(), expected.begin() + (begin - found.begin()),
                   expected.begin() + (end - found.begin()));
  }
  return missing;
}

}  // namespace

SampleTable::SampleTable(const std::filesystem::path& file, bool gaps, Rows rows,
                         Diagnostics& diagnostics)
    : rows_(rows), diagnostics_(diagnostics), before_(diagnostics.error_count()) {
  io::CsvRules rules;
  rules.empty_cells = gaps;
  rules.increasing_first = false;
  table_ = io::read_csv(file, rules, diagnostics);
  if (!good()) return;
  find_time();
  if (good() && rows_ == Rows::time) check_time();
}

void SampleTable::error(int line, int column, const std::string& what) {
  diagnostics_.error(io::cell_position(table_, line, column), what);
}

void SampleTable::row_error(const char* kind, std::size_t row, int column,
                            const std::string& what) {
  const int line = table_.lines[row];
  if (!diagnostics_.again(kind, {table_.file, line, 1}))
    diagnostics_.repeated_error(kind, io::cell_position(table_, line, column), what);
}

void SampleTable::find_time() {
  for (const char* name : {"time", "t", "timestamp"})
    for (int c = 0; time_ < 0 && c < static_cast<int>(table_.columns.size()); ++c)
      if (io::match_column(table_.columns[c], name).matches) {
        time_ = c;
        if (!io::to_si(table_, c, name, io::Quantity::time, diagnostics_)) return;
      }
  if (time_ >= 0 && rows_ == Rows::rest)
    diagnostics_.notice(io::cell_position(table_, table_.header_line, time_),
                        "column " + in_quotes(table_.columns[time_]) +
                            " is not read: the rows of a static series belong together");
  if (time_ < 0 && rows_ == Rows::time)
    return error(table_.header_line, 0,
                 "the first column is " + in_quotes(table_.columns.front()) +
                     ", expected time, and no other column is it");
  for (int c = 0; c < static_cast<int>(table_.columns.size()); ++c)
    if (c != time_ && counts_frames(c)) {
      counters_.push_back(c);
      diagnostics_.notice(
          io::cell_position(table_, table_.header_line, c),
          "column " + in_quotes(table_.columns[c]) + " counts the rows: it is not read");
    }
}

// Named as cameras name it, and one more in every row or as many more as frames were lost.
bool SampleTable::counts_frames(int column) const {
  constexpr const char* names[] = {"frame",  "frames", "frame#", "frame number", "frame_number",
                                   "sample", "index",  "row",    "no",           "#"};
  const bool named = std::ranges::any_of(
      names, [&](const char* name) { return io::same_but_case(table_.columns[column], name); });
  const auto at = [&](std::size_t row) { return table_.rows[row][column]; };
  for (std::size_t r = 0; named && r < table_.rows.size(); ++r)
    if (at(r) != std::floor(at(r)) || (r > 0 && !(at(r) > at(r - 1)))) return false;
  return named;
}

void SampleTable::check_time() {
  for (std::size_t r = 0; r < table_.rows.size(); ++r) {
    if (std::isnan(time(r)))
      row_error("no time", r, time_, table_.columns[time_] + " is empty, expected a time");
    else if (r > 0 && time(r) <= time(r - 1))
      row_error("increase", r, time_,
                table_.columns[time_] + " " + io::format_number(time(r)) +
                    " does not increase, expected more than " + io::format_number(time(r - 1)));
  }
  if (good() && time(0) < 0.0)
    error(table_.lines.front(), time_,
          "time " + io::exact_number(time(0)) + " is before the trial begins, expected >= 0");
}

// Where each name stands, -1: nowhere. What stands twice is an error.
std::vector<int> SampleTable::match(const std::vector<std::string>& expected,
                                    std::vector<std::string>& unknown, int& first_unknown) {
  std::vector<int> found(expected.size(), -1);
  for (int c = 0; c < static_cast<int>(table_.columns.size()); ++c) {
    if (c == time_ || std::ranges::count(counters_, c) > 0) continue;
    const std::string& name = table_.columns[c];
    const int index = index_of_column(expected, name);
    if (index < 0) {
      if (unknown.empty()) first_unknown = c;
      unknown.push_back(name);
    } else if (found[index] >= 0) {
      error(table_.header_line, c,
            "column " + printable(name, 60) + " appears twice, expected it once");
    } else {
      found[index] = c;
    }
  }
  return found;
}

std::vector<int> SampleTable::find(const std::vector<std::string>& expected, io::Quantity quantity,
                                   const std::string& all, NeededAxes axes) {
  std::vector<std::string> unknown;
  int first_unknown = 0;
  std::vector<int> found = match(expected, unknown, first_unknown);
  if (!good()) return found;
  say_differences(unknown, first_unknown, missing_of(expected, found, axes), all);
  for (std::size_t i = 0; good() && i < expected.size(); ++i)
    if (found[i] >= 0) to_si(found[i], expected[i], quantity_of(expected[i], quantity));
  return found;
}

std::vector<int> SampleTable::find_some(const std::vector<Wanted>& wanted, const std::string& all) {
  std::vector<std::string> names, unknown;
  for (const Wanted& one : wanted) names.push_back(one.name);
  int first_unknown = 0;
  std::vector<int> found = match(names, unknown, first_unknown);
  if (!good()) return found;
  const bool none = std::ranges::all_of(found, [](int column) { return column < 0; });
  say_differences(unknown, first_unknown, none ? names : std::vector<std::string>(), all);
  for (std::size_t i = 0; good() && i < names.size(); ++i)
    if (found[i] >= 0) to_si(found[i], names[i], wanted[i].quantity);
  return found;
}

void SampleTable::to_si(int column, const std::string& name, io::Quantity quantity) {
  // What is written otherwise than expected ("M1_X (mm)") goes by the expected name.
  if (!io::match_column(table_.columns[column], name).matches) {
    const std::string unit = io::split_unit(table_.columns[column]).unit;
    table_.columns[column] = unit.empty() ? name : name + " (" + unit + ")";
  }
  io::to_si(table_, column, name, quantity, diagnostics_);
}

// In one sentence, where a table has other names altogether.
void SampleTable::say_differences(std::vector<std::string> unknown, int first_unknown,
                                  const std::vector<std::string>& missing, const std::string& all) {
  if (unknown.empty() && missing.empty()) return;
  for (std::string& name : unknown) name = in_quotes(name);
  std::string what;
  if (!unknown.empty())
    what = unknown.size() == 1 ? "column " + unknown.front() + " is unknown"
                               : "columns " + list_of(unknown) + " are unknown";
  if (!missing.empty())
    what += (what.empty() ? "no column " : " and there is no ") + list_of(missing);
  error(table_.header_line, unknown.empty() ? 0 : first_unknown, what + ", expected " + all);
}

void SampleTable::check_points(const std::vector<int>& columns) {
  for (std::size_t r = 0; r < table_.rows.size(); ++r)
    for (std::size_t c = 0; c + 2 < columns.size(); c += 3) {
      int measured = 0, there = 0, missing = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (columns[c + axis] < 0) continue;
        const bool empty = std::isnan(table_.rows[r][columns[c + axis]]);
        ++measured;
        there += empty ? 0 : 1;
        if (empty) missing = columns[c + axis];
      }
      if (there != 0 && there != measured)
        row_error("half a point", r, missing,
                  table_.columns[missing] +
                      " is empty where the other axes are not, expected all " +
                      (measured == 3 ? "three" : "two") + " or none");
    }
}

Samples SampleTable::samples(const std::vector<int>& columns) const {
  Samples samples;
  if (!good()) return samples;
  samples.value.resize(table_.rows.size(), columns.size());
  for (std::size_t r = 0; r < table_.rows.size(); ++r) {
    samples.time.push_back(time(r));
    for (std::size_t c = 0; c < columns.size(); ++c)
      samples.value(r, c) =
          columns[c] < 0 ? std::numeric_limits<double>::quiet_NaN() : table_.rows[r][columns[c]];
  }
  return samples;
}

}  // namespace pedicel::discrepancy
