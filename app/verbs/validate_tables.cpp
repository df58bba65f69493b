#include "app/verbs/validate_tables.h"

#include <algorithm>
#include <vector>

#include "app/session/commands/command.h"
#include "engine/io/csv.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/skeleton/skeleton_columns.h"

namespace pedicel::app {

namespace {

constexpr const char* readable =
    "a skeleton (x,y,z,parentid,vid,edgetype), cylinders (id,parent_id,start_x,...), markers "
    "(time,NAME.x,NAME.y,NAME.z,...), a path (time,x,y,z), a force (time,fx,fy,fz), force and "
    "moment (time,fx,fy,fz,tx,ty,tz), events "
    "(time,event,what) or a trajectory (time_s,JOINT,...)";

std::vector<std::string> names_of(const io::TableText& table) {
  std::vector<std::string> names;
  for (const io::TableColumn& column : table.columns()) names.push_back(column.name);
  return names;
}

bool has(const std::vector<std::string>& names, const char* wanted) {
  return std::any_of(names.begin() + 1, names.end(), [&](const std::string& name) {
    return io::match_column(name, wanted).matches;
  });
}

// "m1.x (mm)" without its axis; empty where it has none.
std::string marker_of(const std::string& heading) {
  const std::string name = io::split_unit(heading).name;
  for (const char* axis : {".x", ".y", ".z"}) {
    const std::size_t at = name.rfind(axis);
    if (at != std::string::npos && at > 0 && (at + 2 == name.size() || name[at + 2] == '_'))
      return name.substr(0, at);
  }
  return {};
}

TableKind kind_of_columns(const std::vector<std::string>& names) {
  if (plant::looks_like_skeleton(names)) {
    const bool cylinders = std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return io::same_but_case(name.substr(0, 5), "start");
    });
    return cylinders ? TableKind::cylinders : TableKind::skeleton;
  }
  const io::ColumnMatch time = io::match_column(names.front(), "time");
  if (!time.matches && !io::match_column(names.front(), "t").matches) return TableKind::unknown;
  if (has(names, "event")) return TableKind::events;
  // One axis may do.
  const auto all_of = [&](std::initializer_list<const char*> wanted) {
    const auto is_wanted = [&](const std::string& name) {
      return std::any_of(wanted.begin(), wanted.end(),
                         [&](const char* one) { return io::match_column(name, one).matches; });
    };
    return names.size() > 1 && std::all_of(names.begin() + 1, names.end(), is_wanted);
  };
  if (all_of({"fx", "fy", "fz"})) return TableKind::force;
  if (all_of({"fx", "fy", "fz", "tx", "ty", "tz"})) return TableKind::wrench;
  if (has(names, "x") && has(names, "y") && has(names, "z")) return TableKind::path;
  const bool markers = std::all_of(names.begin() + 1, names.end(), [](const std::string& name) {
    return !marker_of(name).empty();
  });
  if (markers) return TableKind::markers;
  return time.matches && !time.unit.empty() ? TableKind::trajectory : TableKind::unknown;
}

std::vector<discrepancy::Marker> markers_of(const io::CsvTable& table) {
  std::vector<discrepancy::Marker> markers;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    discrepancy::Marker marker;
    marker.name = marker_of(table.columns[c]);
    const bool known = std::any_of(markers.begin(), markers.end(),
                                   [&](const auto& one) { return one.name == marker.name; });
    if (!known) markers.push_back(marker);
  }
  return markers;
}

std::string count_text(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

std::string check_markers(const std::filesystem::path& path, Diagnostics& diagnostics) {
  io::CsvRules rules;
  rules.empty_cells = true;
  Diagnostics said_again;
  const auto markers = markers_of(io::read_csv(path, rules, said_again));
  if (said_again.has_errors()) {
    for (const Diagnostic& one : said_again.all()) diagnostics.error(one.where, one.what);
    return {};
  }
  const auto samples = discrepancy::read_markers(path, markers, diagnostics);
  return count_text(markers.size(), "markers, ") + count_text(samples.time.size(), "samples");
}

std::string check_events(const std::filesystem::path& path, Diagnostics& diagnostics) {
  std::vector<SourcePosition> places;
  return count_text(discrepancy::read_event_rows(path, places, diagnostics).size(), "events");
}

// Joints and limits are the robot's, so they are checked with a scene.
std::string check_trajectory(const std::filesystem::path& path, Diagnostics& diagnostics) {
  io::CsvRules rules;
  rules.empty_cells = true;
  io::CsvTable table = io::read_csv(path, rules, diagnostics);
  if (table.columns.empty()) return {};
  io::to_si(table, 0, "time", io::Quantity::time, diagnostics);
  return count_text(table.columns.size() - 1, "columns, ") +
         count_text(table.rows.size(), "rows; joints are checked with the scene that names it");
}

std::string check_unknown(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const std::string text = io::read_text_file(path);
  io::TableText table(text, path.string(), diagnostics);
  if (!table.good()) return {};
  std::string list;
  constexpr std::size_t shown = 8;
  for (std::size_t c = 0; c < std::min(shown, table.columns().size()); ++c)
    list += (c ? ", " : "") + printable(table.columns()[c].name, 30);
  if (table.columns().size() > shown) list += ", ...";
  // What is wrong with it as a table over time helps more than that it is none.
  const bool over_time = io::match_column(table.columns().front().name, "time").matches;
  if (over_time) {
    io::CsvRules rules;
    rules.empty_cells = true;
    io::read_csv(path, rules, diagnostics);
    if (diagnostics.has_errors()) return {};
  }
  diagnostics.error({path.string(), table.header_line(), 1},
                    "nothing reads a table with the columns " + list + ", expected " + readable);
  return {};
}

}  // namespace

std::optional<TableKind> table_kind(const std::filesystem::path& path) {
  Diagnostics unused;
  const std::string text = io::read_text_file(path);
  const io::TableText table(text, path.string(), unused);
  const std::vector<std::string> names = names_of(table);
  if (names.size() < 2) return std::nullopt;
  return kind_of_columns(names);
}

const char* name_of(TableKind kind) {
  switch (kind) {
    case TableKind::skeleton:
      return "skeleton";
    case TableKind::cylinders:
      return "cylinders";
    case TableKind::markers:
      return "markers";
    case TableKind::path:
      return "path";
    case TableKind::force:
      return "force";
    case TableKind::wrench:
      return "force and moment";
    case TableKind::events:
      return "events";
    case TableKind::trajectory:
      return "table over time (trajectory or log)";
    case TableKind::unknown:
      break;
  }
  return "table";
}

std::string check_table(const std::filesystem::path& path, TableKind kind,
                        Diagnostics& diagnostics) {
  switch (kind) {
    case TableKind::markers:
      return check_markers(path, diagnostics);
    case TableKind::path:
      return count_text(discrepancy::read_path(path, diagnostics).time.size(), "rows");
    case TableKind::force:
      return count_text(discrepancy::read_force(path, diagnostics).time.size(), "samples");
    case TableKind::wrench:
      return count_text(discrepancy::read_wrench(path, diagnostics).time.size(), "samples");
    case TableKind::events:
      return check_events(path, diagnostics);
    case TableKind::trajectory:
      return check_trajectory(path, diagnostics);
    default:
      return check_unknown(path, diagnostics);
  }
}

bool is_script(const std::filesystem::path& path) {
  const std::string text = io::read_text_file(path);
  io::RecordScanner lines(text);
  while (lines.next()) {
    const std::string_view line = lines.record();
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#') continue;
    Diagnostics unused;
    return parse_command(std::string(line), {path.string(), lines.line(), 1}, unused).has_value();
  }
  return false;
}

std::string check_script(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const std::string text = io::read_text_file(path);
  std::size_t count = 0;
  int number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string line = text.substr(start, end - start);
    start = end + 1;
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') continue;
    parse_command(line, {path.string(), number, 1}, diagnostics);
    ++count;
  }
  return count_text(count, "commands");
}

}  // namespace pedicel::app
