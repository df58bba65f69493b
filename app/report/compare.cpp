#include "app/report/compare.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pedicel::app {

namespace {

using Rows = std::vector<std::vector<double>>;

/// The log at a time (s); nothing outside of it, and where it has no value.
std::optional<double> log_at(const Rows& rows, std::size_t column, double time) {
  constexpr double slack = 1e-9;  // s
  if (rows.empty() || time < rows.front()[0] - slack || time > rows.back()[0] + slack) return {};
  const auto after =
      std::lower_bound(rows.begin(), rows.end(), time,
                       [](const std::vector<double>& row, double t) { return row[0] < t; });
  if (after == rows.end()) return rows.back()[column];
  if (after == rows.begin()) return rows.front()[column];
  const auto before = after - 1;
  const double share = (time - (*before)[0]) / ((*after)[0] - (*before)[0]);
  // Exactly at a row only that counts: the other may have no value.
  if (share == 1.0) return (*after)[column];
  return (1.0 - share) * (*before)[column] + share * (*after)[column];
}

ColumnComparison compare_column(const io::CsvTable& measured, std::size_t column, const Rows& rows,
                                std::size_t of_log) {
  ColumnComparison found;
  found.column = measured.columns[column];
  double squares = 0.0;
  for (const std::vector<double>& row : measured.rows) {
    const std::optional<double> value = log_at(rows, of_log, row[0]);
    if (!value || std::isnan(row[column])) continue;
    // A log without a value where there is a measured one is as far off as can be.
    const double off = std::isnan(*value) ? std::numeric_limits<double>::infinity()
                                          : std::abs(*value - row[column]);
    ++found.samples;
    squares += off * off;
    if (found.samples > 1 && off <= found.largest) continue;
    found.largest = off;
    found.time = row[0];
  }
  found.rms = found.samples ? std::sqrt(squares / found.samples) : 0.0;
  return found;
}

}  // namespace

bool Comparison::within() const {
  return std::ranges::all_of(columns, [](const ColumnComparison& one) { return one.within; });
}

io::CsvTable read_measured(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  io::CsvTable table = io::read_csv(path, {true, true}, diagnostics);
  if (!diagnostics.has_errors() && table.columns.front() != "time_s")
    diagnostics.error({path.string(), table.header_line, 1},
                      "the first column is \"" + table.columns.front() + "\", expected time_s");
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return table;
}

Comparison compare(const io::CsvTable& measured, double tolerance,
                   const std::vector<std::string>& columns, const Rows& rows) {
  Comparison comparison{measured.file, tolerance, {}, {}};
  for (std::size_t c = 1; c < measured.columns.size(); ++c) {
    const auto of_log = std::ranges::find(columns, measured.columns[c]);
    if (of_log == columns.end()) {
      comparison.left_out.push_back(measured.columns[c]);
      continue;
    }
    ColumnComparison one =
        compare_column(measured, c, rows, static_cast<std::size_t>(of_log - columns.begin()));
    one.within = one.samples > 0 && one.largest <= tolerance;
    comparison.columns.push_back(std::move(one));
  }
  const SourcePosition head{measured.file, measured.header_line, 1};
  if (comparison.columns.empty())
    throw InvalidFile(head, "no column of it is in the log, expected names such as " +
                                (columns.size() > 1 ? columns[1] : "those of log.csv"));
  if (std::ranges::none_of(comparison.columns, [](const auto& one) { return one.samples > 0; }))
    throw InvalidFile(head,
                      "no value of it is at a time of the run, expected time_s from the run's "
                      "start on");
  return comparison;
}

std::string to_string(const ColumnComparison& column, double tolerance) {
  const auto number = [](double value) { return io::format_number(value, 4); };
  return (column.within ? "within  " : "BEYOND  ") + column.column + ": " +
         (column.samples == 0
              ? std::string("no value at a time of the run")
              : "largest " + number(column.largest) + " at " + number(column.time) + " s, rms " +
                    number(column.rms) + ", of " + std::to_string(column.samples) + " samples") +
         " (tolerance " + number(tolerance) + ")";
}

}  // namespace pedicel::app
