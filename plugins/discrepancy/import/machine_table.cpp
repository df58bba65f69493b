#include "plugins/discrepancy/import/machine_table.h"

#include <algorithm>
#include <limits>

#include "engine/io/csv.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "engine/io/unit_text.h"

namespace pedicel::discrepancy {

namespace {

bool is_time_heading(const std::string& heading) {
  constexpr const char* names[] = {"time", "t", "timestamp", "elapsed time"};
  return std::ranges::any_of(
      names, [&](const char* name) { return io::match_column(heading, name).matches; });
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

const MachineColumn* MachineTable::find(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    for (const MachineColumn& column : columns)
      if (io::match_column(column.name, name).matches) return &column;
  return nullptr;
}

const MachineColumn* MachineTable::named(const std::string& name) const {
  const auto found = std::ranges::find_if(columns, [&](const MachineColumn& column) {
    return column.name == name || io::split_unit(column.name).name == name;
  });
  return found == columns.end() ? nullptr : &*found;
}

std::string MachineTable::names() const {
  std::string list;
  for (const MachineColumn& column : columns)
    list += (list.empty() ? "" : ", ") + in_quotes(column.name);
  return list;
}

MachineTable read_machine_table(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const std::string text = without_preamble(io::read_text_file(file));
  io::TableText source(text, file.string(), diagnostics);
  MachineTable table;
  table.head = {file.string(), source.header_line(), 1};
  if (!source.good()) return table;
  for (const io::TableColumn& column : source.columns())
    table.columns.push_back({column.name,
                             unit_of_heading(column),
                             {file.string(), source.header_line(), column.column},
                             {},
                             {},
                             {}});
  while (source.next()) {
    table.lines.push_back(source.line());
    for (std::size_t c = 0; c < table.columns.size(); ++c) take_cell(source, c, table.columns[c]);
  }
  return table;
}

}  // namespace pedicel::discrepancy
