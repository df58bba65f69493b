#include "io/atomic_file.h"
#include "io/csv.h"
#include "robot/joint_range.h"
#include "robot/trajectory.h"

namespace pedicel::robot {

namespace {

/// Where a column's name stands in the header, the first line that is neither blank nor comment.
SourcePosition header_position(const std::filesystem::path& path, std::size_t column) {
  const std::string text = io::read_file(path);
  int line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::size_t first = text.find_first_not_of(" \t\r", start);
    if (first < end && text[start] != '#') {
      std::size_t at = start;
      for (; column > 0; --column) at = text.find(',', at) + 1;
      return {path.string(), line, static_cast<int>(at - start) + 1};
    }
    start = end + 1;
  }
  return {path.string()};
}

std::string expected_names(const KinematicModel& model) {
  std::string names;
  for (const std::string& name : model.joint_names()) names += (names.empty() ? "" : ", ") + name;
  return "expected one of " + names;
}

/// For each column after the first its joint; faults are reported.
std::vector<int> match_columns(const io::CsvTable& table, const std::filesystem::path& path,
                               const RobotDescription& robot, const KinematicModel& model,
                               Diagnostics& diagnostics) {
  if (table.columns[0] != "time_s")
    diagnostics.error(header_position(path, 0),
                      "first column '" + table.columns[0] + "', expected time_s");
  std::vector<int> joints;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    const int index = robot.joint(name);
    const bool follows = index >= 0 && robot.joints[index].mimic.has_value();
    joints.push_back(model.joint_index(name));
    if (table.column(name) != static_cast<int>(c))
      diagnostics.error(header_position(path, c), "column '" + name + "' twice, expected it once");
    else if (follows)
      diagnostics.error(header_position(path, c),
                        "joint '" + name + "' follows '" +
                            robot.joints[robot.joints[index].mimic->source].name +
                            "', expected that one alone");
    else if (joints.back() < 0)
      diagnostics.error(header_position(path, c),
                        "unknown joint '" + name + "', " + expected_names(model));
  }
  return joints;
}

/// The first row of each joint that leaves its limits, and how many more do.
void check_limits(const io::CsvTable& table, const std::vector<int>& joints,
                  const KinematicModel& model, Diagnostics& diagnostics) {
  for (std::size_t c = 0; c < joints.size(); ++c) {
    std::size_t count = 0, first = 0;
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      if (outside_range(model, joints[c], table.rows[r][c + 1]) && count++ == 0) first = r;
    if (count == 0) continue;
    const std::string others =
        count > 1 ? " (and " + std::to_string(count - 1) + " more rows)" : "";
    diagnostics.error({table.file, table.lines[first], 1},
                      *outside_range(model, joints[c], table.rows[first][c + 1]) + others);
  }
}

}  // namespace

Trajectory read_trajectory_csv(const std::filesystem::path& path, const RobotDescription& robot,
                               const KinematicModel& model, const Eigen::VectorXd& q_start,
                               Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  const io::CsvTable table = io::read_csv(path, {}, diagnostics);
  if (diagnostics.error_count() > before) return {};
  const std::vector<int> joints = match_columns(table, path, robot, model, diagnostics);
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
  for (const std::string& joint : model.joint_names()) text += "," + joint;
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
