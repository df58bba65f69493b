#include "plugins/discrepancy/data/experiment_tables.h"

#include <algorithm>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/data/sample_table.h"

namespace pedicel::discrepancy {

namespace {

constexpr double smallest_quaternion = 1.0e-6;
constexpr const char* axes[] = {"x", "y", "z"};

std::string row_text(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (i > 0 ? "," : "") + io::exact_number(values[i]);
  return text + "\n";
}

// An axis without a sample of a point that has others was not measured.
std::vector<int> measured_columns(const Samples& samples) {
  std::vector<int> columns;
  for (int point = 0; point < samples.value.cols(); point += 3) {
    const auto none = [&](int c) { return samples.value.col(c).array().isNaN().all(); };
    const bool unseen = none(point) && none(point + 1) && none(point + 2);
    for (int c = point; c < point + 3; ++c)
      if (unseen || !none(c)) columns.push_back(c);
  }
  return columns;
}

std::string samples_text(const Samples& samples, const std::vector<std::string>& names, Rows rows) {
  const std::vector<int> columns = measured_columns(samples);
  std::string text = rows == Rows::time ? "time" : "";
  for (const int c : columns) text += (text.empty() ? "" : ",") + io::csv_cell(names[c]);
  text += "\n";
  for (int r = 0; r < samples.size(); ++r) {
    std::vector<double> values;
    if (rows == Rows::time) values.push_back(samples.time[r]);
    for (const int c : columns) values.push_back(samples.value(r, c));
    text += row_text(values);
  }
  return text;
}

}  // namespace

DrivenPath read_path(const std::filesystem::path& file, Diagnostics& diagnostics, Rows rows) {
  SampleTable source(file, false, rows, diagnostics);
  if (!source.good()) return {};
  const io::CsvTable& table = source.table();
  const bool turns = source.columns() > 3;
  std::vector<std::string> expected = {"x", "y", "z"};
  if (turns) expected.insert(expected.end(), {"qx", "qy", "qz", "qw"});
  const std::vector<int> at =
      source.find(expected, io::Quantity::length, "time,x,y,z or time,x,y,z,qx,qy,qz,qw");
  if (!source.good()) return {};
  DrivenPath path;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<double>& row = table.rows[r];
    path.time.push_back(source.time(r));
    path.position.emplace_back(row[at[0]], row[at[1]], row[at[2]]);
    if (!turns) continue;
    const Quat q(row[at[6]], row[at[3]], row[at[4]], row[at[5]]);
    if (q.norm() < smallest_quaternion)
      source.row_error("quaternion", r, at[3], "the quaternion has length 0, expected a rotation");
    path.rotation.push_back(q.normalized());
  }
  return source.good() ? path : DrivenPath{};
}

Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics, Rows rows) {
  SampleTable source(file, true, rows, diagnostics);
  if (!source.good()) return {};
  std::vector<std::string> expected;
  std::string all = "time and x, y, z of each marker:";
  for (const Marker& marker : markers) {
    for (const char* axis : axes) expected.push_back(marker.name + "." + axis);
    all += " " + marker.name;
  }
  const std::vector<int> columns =
      source.find(expected, io::Quantity::length, all, NeededAxes::present);
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics, Rows rows) {
  SampleTable source(file, true, rows, diagnostics);
  if (!source.good()) return {};
  const std::vector<int> columns =
      source.find({"fx", "fy", "fz"}, io::Quantity::force, "time,fx,fy,fz", NeededAxes::present);
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

Samples read_wrench(const std::filesystem::path& file, Diagnostics& diagnostics, Rows rows) {
  SampleTable source(file, true, rows, diagnostics);
  if (!source.good()) return {};
  const std::vector<int> columns =
      source.find({"fx", "fy", "fz", "tx", "ty", "tz"}, io::Quantity::force,
                  "time,fx,fy,fz,tx,ty,tz", NeededAxes::any);
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

std::vector<MeasuredEvent> read_event_rows(const std::filesystem::path& file,
                                           std::vector<SourcePosition>& what_is_at,
                                           Diagnostics& diagnostics) {
  std::vector<MeasuredEvent> events;
  const std::string text = io::read_text_file(file);
  io::TableText table(text, file.string(), diagnostics);
  if (!table.good()) return events;
  const auto& columns = table.columns();
  std::string header;
  for (const io::TableColumn& column : columns) header += (header.empty() ? "" : ",") + column.name;
  constexpr const char* names[] = {"time", "event", "what", "by"};
  bool known = columns.size() == 3 || columns.size() == 4;
  for (std::size_t c = 0; known && c < columns.size(); ++c)
    known = io::match_column(columns[c].name, names[c]).matches;
  if (!known) {
    diagnostics.error({file.string(), table.header_line(), 1},
                      "the header is " + in_quotes(header) + ", expected time,event,what");
    return events;
  }
  std::string said = io::match_column(columns[0].name, "time").unit;
  if (said.empty()) said = columns[0].unit;
  const auto unit = said.empty() ? io::Unit{io::Quantity::time, 1.0} : io::unit_of(said);
  if (!unit || unit->quantity != io::Quantity::time) {
    diagnostics.error(
        {file.string(), table.header_line(), 1},
        "time is in " + in_quotes(said) + ", expected " + io::units_of(io::Quantity::time));
    return events;
  }
  while (table.next()) {
    MeasuredEvent event;
    event.time = table.number(0, false) * unit->factor;
    event.event = table.cells()[1].text;
    event.what = table.cells()[2].text;
    what_is_at.push_back(table.at(2));
    events.push_back(std::move(event));
  }
  return events;
}

std::vector<MeasuredEvent> read_events(const std::filesystem::path& file,
                                       const plant::PlantFile& plant, Diagnostics& diagnostics) {
  const auto is_fruit = [&](const std::string& name) {
    return std::ranges::any_of(plant.fruits, [&](const auto& f) { return f.name == name; });
  };
  std::vector<SourcePosition> places;
  const std::vector<MeasuredEvent> events = read_event_rows(file, places, diagnostics);
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i].is_detachment() && !is_fruit(events[i].what))
      diagnostics.repeated_error("no fruit", places[i],
                                 "what: " + in_quotes(events[i].what) + " is no fruit of plant \"" +
                                     plant.name + "\", expected the name of one that detached");
  return events;
}

std::string path_text(const DrivenPath& path, Rows rows) {
  std::string text = rows == Rows::time ? "time,x,y,z" : "x,y,z";
  text += path.rotation.empty() ? "\n" : ",qx,qy,qz,qw\n";
  for (std::size_t r = 0; r < path.time.size(); ++r) {
    std::vector<double> values(path.position[r].begin(), path.position[r].end());
    if (!path.rotation.empty())
      for (const double q : path.rotation[r].coeffs()) values.push_back(q);
    if (rows == Rows::time) values.insert(values.begin(), path.time[r]);
    text += row_text(values);
  }
  return text;
}

std::string markers_text(const Samples& samples, std::span<const Marker> markers, Rows rows) {
  std::vector<std::string> names;
  for (const Marker& marker : markers)
    for (const char* axis : axes) names.push_back(marker.name + "." + axis);
  return samples_text(samples, names, rows);
}

std::string force_text(const Samples& samples, Rows rows) {
  return samples_text(samples, {"fx", "fy", "fz"}, rows);
}

std::string wrench_text(const Samples& samples, Rows rows) {
  return samples_text(samples, {"fx", "fy", "fz", "tx", "ty", "tz"}, rows);
}

std::string events_text(const std::vector<MeasuredEvent>& events) {
  std::string text = "time,event,what\n";
  for (const MeasuredEvent& event : events)
    text +=
        io::exact_number(event.time) + "," + event.event + "," + io::csv_cell(event.what) + "\n";
  return text;
}

}  // namespace pedicel::discrepancy
