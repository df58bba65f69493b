#include "plugins/discrepancy/scene_files/scene_tables.h"

namespace pedicel::discrepancy {

namespace {

/// Columns that a table may have, at least one; `expected` before `names` says what they are.
io::TableSpec some_of(const std::vector<std::string>& columns, io::Quantity quantity,
                      std::string expected, const std::vector<std::string>& names) {
  io::TableSpec spec{.expected = std::move(expected), .needed = io::NeededColumns::any};
  for (const std::string& column : columns) spec.columns.push_back({column, quantity});
  for (const std::string& name : names) spec.expected += " " + name;
  return spec;
}

std::vector<std::string> names_of(const std::vector<SceneMarker>& markers) {
  return marker_columns(markers, {""});
}

}  // namespace

std::vector<std::string> pixel_columns(const std::vector<SceneMarker>& markers) {
  return marker_columns(markers, {".u", ".v"});
}

Samples read_joint_table(const std::filesystem::path& file, const robot::RobotDescription& robot,
                         io::Quantity quantity, std::vector<int>& columns,
                         Diagnostics& diagnostics) {
  const std::vector<std::string> names = joint_names(robot);
  io::TableSpec spec = some_of(names, quantity, "time and joints:", names);
  for (io::ColumnSpec& column : spec.columns) {
    const auto joint = static_cast<std::size_t>(robot.joint(column.name));
    if (robot.joints[joint].type != robot::JointType::prismatic) continue;
    if (quantity == io::Quantity::angle) column.quantity = io::Quantity::length;
    if (quantity == io::Quantity::moment) column.quantity = io::Quantity::force;
  }
  return read_samples(file, spec, diagnostics, &columns);
}

Samples read_scene_markers(const std::filesystem::path& file,
                           const std::vector<SceneMarker>& markers, Diagnostics& diagnostics) {
  return read_samples(file,
                      some_of(marker_columns(markers), io::Quantity::length,
                              "time and x, y, z of markers:", names_of(markers)),
                      diagnostics);
}

Samples read_pixels(const std::filesystem::path& file, const std::vector<SceneMarker>& markers,
                    Diagnostics& diagnostics) {
  return read_samples(file,
                      some_of(pixel_columns(markers), io::Quantity::pixel,
                              "time and u, v of markers:", names_of(markers)),
                      diagnostics);
}

}  // namespace pedicel::discrepancy
