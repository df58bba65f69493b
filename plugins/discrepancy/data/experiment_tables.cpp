#include "pedicel/discrepancy/data/experiment_tables.h"

#include <algorithm>

#include "pedicel/discrepancy/data/sample_table.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"
#include "pedicel/io/table_text.h"
#include "pedicel/io/text_file.h"

namespace pedicel::discrepancy {

namespace {

constexpr double smallest_quaternion = 1.0e-6;
constexpr const char* axes[] = {"x", "y", "z"};

std::string row_text(double time, const std::vector<double>& values) {
  std::string text = io::exact_number(time);
  for (const double value : values) text += "," + io::exact_number(value);
  return text + "\n";
}

std::string rows_text(const Samples& samples) {
  std::string text;
  for (int r = 0; r < samples.size(); ++r) {
    std::vector<double> values;
    for (int c = 0; c < samples.value.cols(); ++c) values.push_back(samples.value(r, c));
    text += row_text(samples.time[r], values);
  }
  return text;
}

}  // namespace

DrivenPath read_path(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SampleTable source(file, false, diagnostics);
  if (!source.good()) return {};
  const io::CsvTable& table = source.table();
  const bool turns = source.columns() > 4;
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
                     Diagnostics& diagnostics) {
  SampleTable source(file, true, diagnostics);
  if (!source.good()) return {};
  std::vector<std::string> expected;
  std::string all = "time and x, y, z of each marker:";
  for (const Marker& marker : markers) {
    for (const char* axis : axes) expected.push_back(marker.name + "." + axis);
    all += " " + marker.name;
  }
  const std::vector<int> columns = source.find(expected, io::Quantity::length, all);
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SampleTable source(file, true, diagnostics);
  if (!source.good()) return {};
  const std::vector<int> columns =
      source.find({"fx", "fy", "fz"}, io::Quantity::force, "time,fx,fy,fz");
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

std::string path_text(const DrivenPath& path) {
  std::string text = path.rotation.empty() ? "time,x,y,z\n" : "time,x,y,z,qx,qy,qz,qw\n";
  for (std::size_t r = 0; r < path.time.size(); ++r) {
    std::vector<double> values(path.position[r].begin(), path.position[r].end());
    if (!path.rotation.empty())
      for (const double q : path.rotation[r].coeffs()) values.push_back(q);
    text += row_text(path.time[r], values);
  }
  return text;
}

std::string markers_text(const Samples& samples, std::span<const Marker> markers) {
  std::string text = "time";
  for (const Marker& marker : markers)
    for (const char* axis : axes) text += "," + marker.name + "." + axis;
  return text + "\n" + rows_text(samples);
}

std::string force_text(const Samples& samples) {
  return "time,fx,fy,fz\n" + rows_text(samples);
}

std::string events_text(const std::vector<MeasuredEvent>& events) {
  std::string text = "time,event,what\n";
  for (const MeasuredEvent& event : events)
    text += io::exact_number(event.time) + "," + event.event + "," + event.what + "\n";
  return text;
}

}  // namespace pedicel::discrepancy
