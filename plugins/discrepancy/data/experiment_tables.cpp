#include "plugins/discrepancy/data/experiment_tables.h"

#include <algorithm>

#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"

namespace pedicel::discrepancy {

namespace {

using io::NeededColumns;
using io::Quantity;

constexpr double smallest_quaternion = 1.0e-6;

std::vector<io::ColumnSpec> columns_of(const std::vector<std::string>& names, Quantity quantity) {
  std::vector<io::ColumnSpec> columns;
  for (const std::string& name : names) columns.push_back({name, quantity});
  return columns;
}

Samples read_points(const std::filesystem::path& file, io::TableSpec spec, Rows rows,
                    Diagnostics& diagnostics) {
  spec.whole_points = true;
  spec.time.there = rows == Rows::time;
  return read_samples(file, spec, diagnostics);
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

/// Columns that a table may have, at least one; `expected` before `names` says what they are.
io::TableSpec some_of(const std::vector<std::string>& columns, Quantity quantity,
                      std::string expected, const std::vector<std::string>& names) {
  io::TableSpec spec{.expected = std::move(expected), .needed = NeededColumns::any};
  for (const std::string& column : columns) spec.columns.push_back({column, quantity});
  for (const std::string& name : names) spec.expected += " " + name;
  return spec;
}

}  // namespace

Eigen::MatrixXd matrix_of_rows(const std::vector<double>& values, std::size_t columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if (columns == 0) return {};
  return Eigen::Map<const RowMajor>(values.data(), static_cast<long>(values.size() / columns),
                                    static_cast<long>(columns));
}

Samples read_samples(const std::filesystem::path& file, const io::TableSpec& spec,
                     Diagnostics& diagnostics, std::vector<int>* present) {
  io::SpecTable table(file, spec, diagnostics);
  std::vector<int> columns;
  for (std::size_t c = 0; c < spec.columns.size(); ++c)
    if (!present || table.has(c)) columns.push_back(static_cast<int>(c));
  Samples samples;
  std::vector<double> values;
  while (table.next()) {
    samples.time.push_back(table.time());
    for (const int c : columns) values.push_back(table.value(static_cast<std::size_t>(c)));
  }
  if (!table.good()) return {};
  samples.value = matrix_of_rows(values, columns.size());
  if (present) *present = columns;
  return samples;
}

DrivenPath read_path(const std::filesystem::path& file, Diagnostics& diagnostics, Rows rows) {
  io::TableSpec spec{.columns = columns_of({"x", "y", "z"}, Quantity::length),
                     .expected = "time,x,y,z or time,x,y,z,qx,qy,qz,qw",
                     .needed_first = 3,
                     .gaps = false};
  for (const char* name : {"qx", "qy", "qz", "qw"}) spec.columns.push_back({name});
  spec.time.there = rows == Rows::time;
  io::SpecTable table(file, spec, diagnostics);
  DrivenPath path;
  while (table.next()) {
    path.time.push_back(table.time());
    path.position.emplace_back(table.value(0), table.value(1), table.value(2));
    if (!table.has(3)) continue;
    const Quat q(table.value(6), table.value(3), table.value(4), table.value(5));
    if (q.norm() < smallest_quaternion)
      table.row_error("quaternion", 3, "the quaternion has length 0, expected a rotation");
    path.rotation.push_back(q.normalized());
  }
  return table.good() ? path : DrivenPath{};
}

Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics, Rows rows) {
  std::string all = "time and x, y, z of each marker:";
  for (const Marker& marker : markers) all += " " + marker.name;
  return read_points(file,
                     {.columns = columns_of(marker_columns(markers), Quantity::length),
                      .expected = all,
                      .needed = NeededColumns::points},
                     rows, diagnostics);
}

Samples read_some_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                          Diagnostics& diagnostics) {
  return read_samples(file,
                      some_of(marker_columns(markers), Quantity::length,
                              "time and x, y, z of markers:", marker_columns(markers, {""})),
                      diagnostics);
}

Samples read_pixels(const std::filesystem::path& file, std::span<const Marker> markers,
                    Diagnostics& diagnostics) {
  return read_samples(file,
                      some_of(pixel_columns(markers), Quantity::pixel,
                              "time and u, v of markers:", marker_columns(markers, {""})),
                      diagnostics);
}

Samples read_joint_table(const std::filesystem::path& file, const robot::RobotDescription& robot,
                         Quantity quantity, std::vector<int>& columns, Diagnostics& diagnostics) {
  const std::vector<std::string> names = joint_names(robot);
  io::TableSpec spec = some_of(names, quantity, "time and joints:", names);
  for (io::ColumnSpec& column : spec.columns) {
    const auto joint = static_cast<std::size_t>(robot.joint(column.name));
    if (robot.joints[joint].type != robot::JointType::prismatic) continue;
    if (quantity == Quantity::angle) column.quantity = Quantity::length;
    if (quantity == Quantity::moment) column.quantity = Quantity::force;
  }
  return read_samples(file, spec, diagnostics, &columns);
}

Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics, Rows rows) {
  return read_points(file,
                     {.columns = columns_of({"fx", "fy", "fz"}, Quantity::force),
                      .expected = "time,fx,fy,fz",
                      .needed = NeededColumns::any},
                     rows, diagnostics);
}

std::vector<std::string> marker_columns(std::span<const Marker> markers,
                                        const std::vector<const char*>& axes) {
  std::vector<std::string> names;
  for (const Marker& marker : markers)
    for (const char* axis : axes) names.push_back(marker.name + axis);
  return names;
}

std::vector<std::string> pixel_columns(std::span<const Marker> markers) {
  return marker_columns(markers, {".u", ".v"});
}

std::vector<std::string> wrench_columns() {
  return {"fx", "fy", "fz", "tx", "ty", "tz"};
}

io::TableSpec wrench_spec() {
  io::TableSpec spec{.columns = columns_of(wrench_columns(), Quantity::force),
                     .expected = "time,fx,fy,fz,tx,ty,tz",
                     .needed = NeededColumns::any};
  for (std::size_t i = 3; i < 6; ++i) spec.columns[i].quantity = Quantity::moment;
  return spec;
}

Samples read_wrench(const std::filesystem::path& file, Diagnostics& diagnostics, Rows rows) {
  return read_points(file, wrench_spec(), rows, diagnostics);
}

std::vector<MeasuredEvent> read_events(
    const std::filesystem::path& file, Diagnostics& diagnostics,
    const std::function<void(const MeasuredEvent&, io::SpecTable&)>& check) {
  io::SpecTable table(
      file,
      {.columns = {{"event", std::nullopt}, {"what", std::nullopt}, {"by", std::nullopt}},
       .expected = "time,event,what or time,event,what,by",
       .needed_first = by_column,
       .needs_rows = false,
       .time = {.increasing = false, .from_zero = false}},
      diagnostics);
  std::vector<MeasuredEvent> events;
  while (table.next()) {
    events.push_back(
        {table.time(), table.text(event_column), table.text(what_column), table.text(by_column)});
    if (check) check(events.back(), table);
  }
  return events;
}

std::string table_text(const std::vector<std::string>& names, const Samples& samples, Rows rows) {
  const bool timed = rows == Rows::time;
  std::string text = timed ? "time" : "";
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + io::csv_cell(name);
  for (int r = 0; r < samples.size(); ++r) {
    text += "\n" + (timed ? io::exact_number(samples.time[static_cast<std::size_t>(r)]) : "");
    for (long c = 0; c < samples.value.cols(); ++c)
      text += (c > 0 || timed ? "," : "") + io::exact_number(samples.value(r, c));
  }
  return text + "\n";
}

std::string points_text(const std::vector<std::string>& names, const Samples& samples, Rows rows) {
  const std::vector<int> columns = measured_columns(samples);
  std::vector<std::string> measured;
  for (const int c : columns) measured.push_back(names[static_cast<std::size_t>(c)]);
  return table_text(measured, {samples.time, samples.value(Eigen::all, columns)}, rows);
}

std::string path_text(const DrivenPath& path, Rows rows) {
  std::vector<std::string> names = {"x", "y", "z"};
  if (!path.rotation.empty()) names.insert(names.end(), {"qx", "qy", "qz", "qw"});
  Samples samples{path.time, Eigen::MatrixXd(path.time.size(), names.size())};
  for (int r = 0; r < samples.size(); ++r) {
    const auto row = static_cast<std::size_t>(r);
    samples.value.block<1, 3>(r, 0) = path.position[row].transpose();
    if (!path.rotation.empty())
      samples.value.block<1, 4>(r, 3) = path.rotation[row].coeffs().transpose();
  }
  return table_text(names, samples, rows);
}

std::string events_text(const std::vector<MeasuredEvent>& events) {
  const bool by = std::ranges::any_of(events, [](const auto& event) { return !event.by.empty(); });
  std::string text = by ? "time,event,what,by\n" : "time,event,what\n";
  for (const MeasuredEvent& event : events)
    text += io::exact_number(event.time) + "," + event.event + "," + io::csv_cell(event.what) +
            (by ? "," + io::csv_cell(event.by) : "") + "\n";
  return text;
}

}  // namespace pedicel::discrepancy
