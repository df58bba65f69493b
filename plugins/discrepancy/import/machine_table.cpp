#include "plugins/discrepancy/import/machine_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/csv.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"

namespace pedicel::discrepancy {

namespace {

/// By words that recorders use. A column of numbers that merely rise is not taken for a clock.
constexpr const char* time_names[] = {"time", "t", "timestamp", "elapsed time", "time stamp"};

bool is_time_heading(const std::string& heading) {
  return std::ranges::any_of(
      time_names, [&](const char* name) { return io::match_column(heading, name).matches; });
}

bool names_a_time(std::string_view record) {
  for (const char separator : {',', ';', '\t'}) {
    io::CellSplitter splitter(separator);
    const auto& cells = splitter.split(record);
    if (cells.size() > 1 && std::ranges::any_of(cells, [](const io::TableCell& cell) {
          return is_time_heading(std::string(cell.text));
        }))
      return true;
  }
  return false;
}

/// Without the lines above the names: they become empty ones, so that lines keep their numbers.
std::string without_preamble(std::string text) {
  io::RecordScanner scanner(text);
  while (scanner.next()) {
    if (!names_a_time(scanner.record())) continue;
    const auto head = static_cast<std::size_t>(scanner.record().data() - text.data());
    for (std::size_t i = 0; i < head; ++i)
      if (text[i] != '\n' && text[i] != '\r') text[i] = ' ';
    break;
  }
  return text;
}

std::string unit_of_heading(const io::TableColumn& column) {
  if (!column.unit.empty()) return column.unit;
  if (const std::string unit = io::split_unit(column.name).unit; !unit.empty()) return unit;
  const std::size_t mark = column.name.rfind('_');  // load_N
  if (mark == std::string::npos) return {};
  const std::string behind = column.name.substr(mark + 1);
  return io::unit_of(behind) ? behind : std::string();
}

void take_cell(const io::TableText& table, std::size_t c, MachineColumn& column) {
  const std::string_view text = table.cells()[c].text;
  const io::NumberText number = io::number_of(text, table.dialect().numbers);
  const bool is_number = number.kind == io::NumberText::Kind::number;
  column.values.push_back(is_number ? number.value : std::numeric_limits<double>::quiet_NaN());
  column.columns.push_back(table.cells()[c].column);
  if (!is_number && number.kind != io::NumberText::Kind::missing && column.fault.what.empty())
    column.fault = {Severity::error, table.at(c),
                    in_quotes(text) + " " + io::why_no_number(text, table.dialect().numbers)};
}

}  // namespace

MachineTable::MachineTable(const std::filesystem::path& file, Diagnostics& diagnostics,
                           ImportNotes& notes)
    : diagnostics_(diagnostics), notes_(notes) {
  const std::string text = without_preamble(io::read_text_file(file));
  io::TableText source(text, file.string(), diagnostics);
  head_ = {file.string(), source.header_line(), 1};
  if (!source.good()) return;
  for (const io::TableColumn& column : source.columns())
    columns_.push_back({column.name,
                        unit_of_heading(column),
                        {file.string(), source.header_line(), column.column},
                        {},
                        {},
                        {}});
  while (source.next()) {
    lines_.push_back(source.line());
    for (std::size_t c = 0; c < columns_.size(); ++c) take_cell(source, c, columns_[c]);
  }
}

const MachineColumn* MachineTable::find(const char* name) const {
  for (const MachineColumn& column : columns_)
    if (io::match_column(column.name, name).matches) return &column;
  return nullptr;
}

const MachineColumn* MachineTable::named(const std::string& name) const {
  for (const MachineColumn& column : columns_)
    if (column.name == name || io::split_unit(column.name).name == name) return &column;
  // With all names, since most such words are misspelt ones.
  error("no column " + in_quotes(name) + ", expected one of: " + names());
  return nullptr;
}

const MachineColumn* MachineTable::lone_force(const std::string& option) const {
  std::vector<const MachineColumn*> found;
  for (const MachineColumn& column : columns_) {
    const auto unit = io::unit_of(column.unit);
    const bool known = io::match_column(column.name, "force").matches ||
                       io::match_column(column.name, "load").matches;
    // A unit says more than a name: "load (mm)" is no force.
    if (unit ? unit->quantity == io::Quantity::force : known) found.push_back(&column);
  }
  // Of several forces none is taken: the wrong one would be judged without a word.
  if (found.size() == 1) return found.front();
  notes_.missing.push_back(head_.file + (found.empty() ? ": no column" : ": more than one column") +
                           " is a force, expected " + option + ": " + names());
  return nullptr;
}

std::string MachineTable::names() const {
  std::string list;
  for (const MachineColumn& column : columns_)
    list += (list.empty() ? "" : ", ") + in_quotes(column.name);
  return list;
}

std::vector<double> MachineTable::si_values(const MachineColumn& column, io::Quantity quantity,
                                            const StatedColumnUnit& stated) const {
  const auto unit = io::unit_of(column.unit);
  const std::string name = "column " + in_quotes(column.name);
  if (!column.fault.what.empty()) {
    diagnostics_.error(column.fault.where, column.fault.what);
    return {};
  }
  if (!stated.factor && column.unit.empty()) {
    notes_.missing.push_back(head_.file + ": " + name + " has no unit, expected " + stated.option +
                             " with " + io::units_of(quantity));
    return {};
  }
  if (!stated.factor && (!unit || unit->quantity != quantity)) {
    diagnostics_.error(column.where, name + " is in " + in_quotes(column.unit) + ", expected " +
                                         io::units_of(quantity));
    return {};
  }
  if (stated.factor && unit && unit->factor != *stated.factor)
    notes_.said.push_back(std::filesystem::path(head_.file).filename().string() +
                          ": warning: " + name + " is in " + in_quotes(column.unit) + ", and " +
                          stated.option + " says otherwise, which counts");
  std::vector<double> values = column.values;
  for (double& value : values) value *= stated.factor ? *stated.factor : unit->factor;
  return values;
}

std::vector<double> MachineTable::times(const std::optional<std::string>& name,
                                        const StatedColumnUnit& stated,
                                        const std::string& expected) const {
  const MachineColumn* time = name ? named(*name) : nullptr;
  for (const char* known : time_names)
    if (!name && time == nullptr) time = find(known);
  if (time == nullptr && !name) error("no column is the time, expected one named " + expected);
  if (time == nullptr) return {};
  std::vector<double> values = si_values(*time, io::Quantity::time, stated);
  // A clock that jumps back would make spans of no time.
  if (!values.empty()) check_increasing(*time);
  return values;
}

void MachineTable::check_increasing(const MachineColumn& time) const {
  for (std::size_t r = 0; r < time.values.size(); ++r)
    if (std::isnan(time.values[r]) || (r > 0 && time.values[r] <= time.values[r - 1]))
      return diagnostics_.error({head_.file, lines_[r], time.columns[r]},
                                "time does not increase here, expected one recording in time");
}

}  // namespace pedicel::discrepancy
