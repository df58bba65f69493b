#include "plugins/discrepancy/scene_files/scene_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/csv_cell.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/data/sample_table.h"

namespace pedicel::discrepancy {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

using Column = SampleTable::Wanted;

/// Columns that a table may have. At least one; what is not among them is an error.
Samples read_some(const std::filesystem::path& file, const std::vector<Column>& wanted,
                  const std::string& all, std::vector<int>* present, Diagnostics& diagnostics) {
  SampleTable table(file, true, Rows::time, diagnostics);
  if (!table.good()) return {};
  const std::vector<int> at = table.find_some(wanted, all);
  if (!table.good()) return {};
  Samples samples;
  const std::size_t rows = table.table().rows.size();
  for (std::size_t r = 0; r < rows; ++r) samples.time.push_back(table.time(r));
  std::vector<int> columns;
  for (std::size_t c = 0; c < at.size(); ++c)
    if (!present || at[c] >= 0) columns.push_back(static_cast<int>(c));
  if (present) *present = columns;
  samples.value.setConstant(static_cast<long>(rows), static_cast<long>(columns.size()), missing);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (const int from = at[static_cast<std::size_t>(columns[c])]; from >= 0)
        samples.value(static_cast<long>(r), static_cast<long>(c)) =
            table.table().rows[r][static_cast<std::size_t>(from)];
  return samples;
}

std::vector<Column> with(const std::vector<std::string>& names, io::Quantity quantity) {
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back({name, quantity});
  return columns;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += " " + name;
  return list;
}

}  // namespace

std::vector<std::string> marker_columns(const std::vector<SceneMarker>& markers) {
  std::vector<std::string> names;
  for (const SceneMarker& marker : markers)
    for (const char* axis : {".x", ".y", ".z"}) names.push_back(marker.name + axis);
  return names;
}

std::vector<std::string> pixel_columns(const std::vector<SceneMarker>& markers) {
  std::vector<std::string> names;
  for (const SceneMarker& marker : markers)
    for (const char* axis : {".u", ".v"}) names.push_back(marker.name + axis);
  return names;
}

std::vector<std::string> wrench_columns() {
  return {"fx", "fy", "fz", "tx", "ty", "tz"};
}

Samples read_joint_table(const std::filesystem::path& file, const robot::RobotDescription& robot,
                         io::Quantity quantity, std::vector<int>& columns,
                         Diagnostics& diagnostics) {
  std::vector<Column> wanted;
  for (const std::string& name : joint_names(robot)) {
    const bool slides = robot.joints[static_cast<std::size_t>(robot.joint(name))].type ==
                        robot::JointType::prismatic;
    io::Quantity own = quantity;
    if (slides && own == io::Quantity::angle) own = io::Quantity::length;
    if (slides && own == io::Quantity::moment) own = io::Quantity::force;
    wanted.push_back({name, own});
  }
  return read_some(file, wanted, "time and joints:" + list_of(joint_names(robot)), &columns,
                   diagnostics);
}

Samples read_scene_markers(const std::filesystem::path& file,
                           const std::vector<SceneMarker>& markers, Diagnostics& diagnostics) {
  std::string all = "time and x, y, z of markers:";
  for (const SceneMarker& marker : markers) all += " " + marker.name;
  return read_some(file, with(marker_columns(markers), io::Quantity::length), all, nullptr,
                   diagnostics);
}

Samples read_pixels(const std::filesystem::path& file, const std::vector<SceneMarker>& markers,
                    Diagnostics& diagnostics) {
  std::string all = "time and u, v of markers:";
  for (const SceneMarker& marker : markers) all += " " + marker.name;
  return read_some(file, with(pixel_columns(markers), io::Quantity::pixel), all, nullptr,
                   diagnostics);
}

Samples read_wrench(const std::filesystem::path& file, Diagnostics& diagnostics) {
  std::vector<Column> wanted;
  for (const std::string& name : wrench_columns())
    wanted.push_back({name, name[0] == 'f' ? io::Quantity::force : io::Quantity::moment});
  return read_some(file, wanted, "time,fx,fy,fz,tx,ty,tz", nullptr, diagnostics);
}

std::vector<SceneEvent> read_scene_events(const std::filesystem::path& file,
                                          std::vector<SourcePosition>& places,
                                          Diagnostics& diagnostics) {
  std::vector<SceneEvent> events;
  const std::string text = io::read_text_file(file);
  io::TableText table(text, file.string(), diagnostics);
  if (!table.good()) return events;
  constexpr const char* names[] = {"time", "event", "what", "by"};
  const auto& columns = table.columns();
  std::string header;
  bool known = columns.size() == 3 || columns.size() == 4;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    header += (c > 0 ? "," : "") + columns[c].name;
    known = known && io::match_column(columns[c].name, names[c]).matches;
  }
  if (!known) {
    diagnostics.error({file.string(), table.header_line(), 1},
                      "the header is " + in_quotes(header) + ", expected time,event,what,by");
    return events;
  }
  constexpr const char* kinds[] = {"grasped", "released", "detached", "slipped"};
  while (table.next()) {
    SceneEvent event;
    event.time = table.number(0, false);
    event.event = table.cells()[1].text;
    event.what = table.cells()[2].text;
    if (columns.size() == 4) event.by = table.cells()[3].text;
    if (std::ranges::find(kinds, event.event) == std::end(kinds))
      diagnostics.repeated_error(
          "no event", table.at(1),
          "event: " + in_quotes(event.event) + ", expected grasped, released, detached or slipped");
    if (!(event.time >= 0.0))
      diagnostics.repeated_error("no time", table.at(0),
                                 "the event is before the trial begins, expected a time >= 0");
    places.push_back(table.at(2));
    events.push_back(std::move(event));
  }
  return events;
}

std::string table_text(const std::vector<std::string>& names, const Samples& samples) {
  std::string text = "time";
  for (const std::string& name : names) text += "," + io::csv_cell(name);
  text += "\n";
  for (int r = 0; r < samples.size(); ++r) {
    text += io::exact_number(samples.time[static_cast<std::size_t>(r)]);
    for (long c = 0; c < samples.value.cols(); ++c)
      text += "," + io::exact_number(samples.value(r, c));
    text += "\n";
  }
  return text;
}

std::string scene_events_text(const std::vector<SceneEvent>& events) {
  std::string text = "time,event,what,by\n";
  for (const SceneEvent& event : events)
    text += io::exact_number(event.time) + "," + event.event + "," + io::csv_cell(event.what) +
            "," + io::csv_cell(event.by) + "\n";
  return text;
}

}  // namespace pedicel::discrepancy
