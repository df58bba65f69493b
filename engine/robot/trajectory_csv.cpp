#include <algorithm>

#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"
#include "engine/robot/joint_range.h"
#include "engine/robot/trajectory.h"

namespace pedicel::robot {

namespace {

std::string expected_names(const KinematicModel& model) {
  std::string names;
  for (const std::string& name : model.joint_names()) names += (names.empty() ? "" : ", ") + name;
  return "expected one of " + names;
}

/// The joint that a column is about: by its name, else by its name with a unit behind it.
std::string joint_of(const std::string& heading, const RobotDescription& robot) {
  if (robot.joint(heading) >= 0) return heading;
  for (const Joint& joint : robot.joints)
    if (io::match_column(heading, joint.name).matches) return joint.name;
  return heading;
}

/// For each column after the first its joint, everything in s and rad or m; faults are reported.
std::vector<int> match_columns(io::CsvTable& table, const RobotDescription& robot,
                               const KinematicModel& model, Diagnostics& diagnostics) {
  const auto error = [&](std::size_t column, const std::string& what) {
    diagnostics.error(io::cell_position(table, table.header_line, static_cast<int>(column)), what);
  };
  const io::ColumnMatch time = io::match_column(table.columns[0], "time");
  if (!time.matches || (time.unit.empty() && table.units[0].empty()))
    error(0, "first column '" + table.columns[0] + "', expected time_s");
  else
    io::to_si(table, 0, "time", io::Quantity::time, diagnostics);
  std::vector<int> joints;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    const std::string name = joint_of(table.columns[c], robot);
    const int index = robot.joint(name);
    const bool follows = index >= 0 && robot.joints[index].mimic.has_value();
    const int joint = model.joint_index(name);
    if (joint >= 0 && std::find(joints.begin(), joints.end(), joint) != joints.end())
      error(c, "column '" + table.columns[c] + "' twice, expected it once");
    else if (follows)
      error(c, "joint '" + name + "' follows '" +
                   robot.joints[robot.joints[index].mimic->source].name +
                   "', expected that one alone");
    else if (joint < 0)
      error(c, "unknown joint '" + name + "', " + expected_names(model));
    else
      io::to_si(table, static_cast<int>(c), name,
                robot.joints[index].type == JointType::prismatic ? io::Quantity::length
                                                                 : io::Quantity::angle,
                diagnostics);
    joints.push_back(joint);
  }
  return joints;
}

/// Each joint that leaves its limits, once.
void check_limits(const io::CsvTable& table, const std::vector<int>& joints,
                  const KinematicModel& model, Diagnostics& diagnostics) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    for (std::size_t c = 0; c < joints.size(); ++c)
      if (const auto outside = outside_range(model, joints[c], table.rows[r][c + 1]))
        diagnostics.repeated_error("limit of " + table.columns[c + 1],
                                   {table.file, table.lines[r], 1}, *outside);
}

}  // namespace

Trajectory read_trajectory_csv(const std::filesystem::path& path, const RobotDescription& robot,
                               const KinematicModel& model, const Eigen::VectorXd& q_start,
                               Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  io::CsvTable table = io::read_csv(path, {}, diagnostics);
  if (diagnostics.error_count() > before) return {};
  const std::vector<int> joints = match_columns(table, robot, model, diagnostics);
  if (diagnostics.error_count() > before) return {};
  check_limits(table, joints, model, diagnostics);
  if (diagnostics.error_count() > before) return {};

  std::vector<double> times;
  std::vector<Eigen::VectorXd> positions;
  for (const std::vector<double>& row : table.rows) {
    times.push_back(row[0]);
    positions.push_back(q_start);
    for (std::size_t c = 0; c < joints.size(); ++c) positions.back()[joints[c]] = row[c + 1];
  }
  return Trajectory(std::move(times), std::move(positions));
}

std::string trajectory_csv(const Trajectory& trajectory, const KinematicModel& model) {
  constexpr int every_digit = 17;
  std::string text = "time_s";
  for (const std::string& joint : model.joint_names()) text += "," + io::csv_cell(joint);
  text += "\n";
  for (std::size_t row = 0; row < trajectory.times().size(); ++row) {
    text += io::format_number(trajectory.times()[row], every_digit);
    for (const double q : trajectory.positions()[row])
      text += "," + io::format_number(q, every_digit);
    text += "\n";
  }
  return text;
}

}  // namespace pedicel::robot
