#include "app/verbs/validate_tables.h"

#include <algorithm>
#include <vector>

#include "app/session/commands/command.h"
#include "engine/io/csv.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/skeleton/skeleton_columns.h"

namespace pedicel::app {

namespace {

constexpr const char* readable =
    "a skeleton (x,y,z,parentid,vid,edgetype), cylinders (id,parent_id,start_x,...), markers "
    "(time,NAME.x,NAME.y,NAME.z,...), a path (time,x,y,z), a force (time,fx,fy,fz), force and "
    "moment (time,fx,fy,fz,tx,ty,tz), events "
    "(time,event,what) or a trajectory (time_s,JOINT,...)";

std::vector<std::string> column_names(const std::filesystem::path& path) {
  Diagnostics unused;
  const std::string text = io::read_text_file(path);
  const io::TableText table(text, path.string(), unused);
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

std::vector<discrepancy::Marker> markers_of(const std::vector<std::string>& names) {
  std::vector<discrepancy::Marker> markers;
  for (std::size_t c = 1; c < names.size(); ++c) {
    const std::string name = marker_of(names[c]);
    if (std::ranges::find(markers, name, &discrepancy::Marker::name) == markers.end())
      markers.push_back({name, {}});
  }
  return markers;
}

std::string count_text(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

std::string check_markers(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const auto markers = markers_of(column_names(path));
  const auto samples = discrepancy::read_markers(path, markers, diagnostics);
  return count_text(markers.size(), "markers, ") + count_text(samples.time.size(), "samples");
}

std::string check_path(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return count_text(discrepancy::read_path(path, diagnostics).time.size(), "rows");
}

std::string check_force(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return count_text(discrepancy::read_force(path, diagnostics).time.size(), "samples");
}

std::string check_wrench(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return count_text(discrepancy::read_wrench(path, diagnostics).time.size(), "samples");
}

std::string check_events(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return count_text(discrepancy::read_events(path, diagnostics).size(), "events");
}

// Joints and limits are the robot's, so they are checked with a scene.
std::string check_trajectory(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const io::CsvTable table = io::read_csv(path, {.empty_cells = true}, diagnostics);
  if (table.columns.empty()) return {};
  const std::string unit = io::match_column(table.columns[0], "time").unit;
  if (const auto known = io::unit_of(unit); !known || known->quantity != io::Quantity::time)
    diagnostics.error({path.string(), table.header_line, 1},
                      "column " + in_quotes(table.columns[0]) + " is in " + in_quotes(unit) +
                          ", expected " + io::units_of(io::Quantity::time));
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
    io::read_csv(path, {.empty_cells = true}, diagnostics);
    if (diagnostics.has_errors()) return {};
  }
  diagnostics.error({path.string(), table.header_line(), 1},
                    "nothing reads a table with the columns " + list + ", expected " + readable);
  return {};
}

constexpr TableKind skeleton_table{"skeleton", nullptr}, cylinder_table{"cylinders", nullptr},
    marker_table{"markers", check_markers}, path_table{"path", check_path},
    force_table{"force", check_force}, wrench_table{"force and moment", check_wrench},
    event_table{"events", check_events},
    trajectory_table{"table over time (trajectory or log)", check_trajectory};

const TableKind& kind_of_columns(const std::vector<std::string>& names) {
  if (plant::looks_like_skeleton(names)) {
    const bool cylinders = std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return io::same_but_case(name.substr(0, 5), "start");
    });
    return cylinders ? cylinder_table : skeleton_table;
  }
  const io::ColumnMatch time = io::match_column(names.front(), "time");
  if (!time.matches && !io::match_column(names.front(), "t").matches) return unknown_table;
  if (has(names, "event")) return event_table;
  // One axis may do.
  const auto all_of = [&](std::initializer_list<const char*> wanted) {
    const auto is_wanted = [&](const std::string& name) {
      return std::any_of(wanted.begin(), wanted.end(),
                         [&](const char* one) { return io::match_column(name, one).matches; });
    };
    return names.size() > 1 && std::all_of(names.begin() + 1, names.end(), is_wanted);
  };
  if (all_of({"fx", "fy", "fz"})) return force_table;
  if (all_of({"fx", "fy", "fz", "tx", "ty", "tz"})) return wrench_table;
  if (has(names, "x") && has(names, "y") && has(names, "z")) return path_table;
  const bool markers = std::all_of(names.begin() + 1, names.end(), [](const std::string& name) {
    return !marker_of(name).empty();
  });
  if (markers) return marker_table;
  return time.matches && !time.unit.empty() ? trajectory_table : unknown_table;
}

/// Each line that is neither blank nor a comment, with its number, until `take` says false.
template <class Take>
void for_each_command(const std::filesystem::path& path, const Take& take) {
  const std::string text = io::read_text_file(path);
  int number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string line = text.substr(start, end - start);
    start = end + 1;
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') continue;
    if (!take(line, SourcePosition{path.string(), number, 1})) return;
  }
}

}  // namespace

const TableKind unknown_table{"table", check_unknown};

const TableKind* table_kind(const std::filesystem::path& path) {
  const std::vector<std::string> names = column_names(path);
  return names.size() < 2 ? nullptr : &kind_of_columns(names);
}

bool is_script(const std::filesystem::path& path) {
  bool found = false;
  for_each_command(path, [&](const std::string& line, const SourcePosition& where) {
    Diagnostics unused;
    found = parse_command(line, where, unused).has_value();
    return false;
  });
  return found;
}

std::string check_script(const std::filesystem::path& path, Diagnostics& diagnostics) {
  std::size_t count = 0;
  for_each_command(path, [&](const std::string& line, const SourcePosition& where) {
    parse_command(line, where, diagnostics);
    ++count;
    return true;
  });
  return count_text(count, "commands");
}

}  // namespace pedicel::app
