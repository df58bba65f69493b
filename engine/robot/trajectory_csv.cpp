#include <cmath>

#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"
#include "engine/io/table_spec.h"
#include "engine/robot/joint_range.h"
#include "engine/robot/trajectory.h"

namespace pedicel::robot {

namespace {

/// All joints, with those that follow others, which a table may not have.
io::TableSpec spec_of(const RobotDescription& robot, const KinematicModel& model) {
  io::TableSpec spec{.expected = "time_s and joints:",
                     .needed = io::NeededColumns::none,
                     .gaps = false,
                     .time = {.needs_unit = true, .from_zero = false}};
  for (const std::string& name : model.joint_names()) spec.expected += " " + name;
  for (const Joint& joint : robot.joints)
    if (joint.mimic || model.joint_index(joint.name) >= 0)
      spec.columns.push_back({joint.name, joint.type == JointType::prismatic
                                              ? io::Quantity::length
                                              : io::Quantity::angle});
  return spec;
}

void check_followers(const RobotDescription& robot, const io::TableSpec& spec,
                     io::SpecTable& table) {
  for (std::size_t c = 0; c < spec.columns.size(); ++c) {
    const auto& mimic = robot.joints[robot.joint(spec.columns[c].name)].mimic;
    if (mimic && table.has(c))
      table.name_error(c, "joint '" + spec.columns[c].name + "' follows '" +
                              robot.joints[mimic->source].name + "', expected that one alone");
  }
}

}  // namespace

Trajectory read_trajectory_csv(const std::filesystem::path& path, const RobotDescription& robot,
                               const KinematicModel& model, const Eigen::VectorXd& q_start,
                               Diagnostics& diagnostics) {
  const io::TableSpec spec = spec_of(robot, model);
  io::SpecTable table(path, spec, diagnostics);
  check_followers(robot, spec, table);
  std::vector<double> times;
  std::vector<Eigen::VectorXd> positions;
  if (!table.good()) return {};
  while (table.next()) {
    times.push_back(table.time());
    positions.push_back(q_start);
    for (std::size_t c = 0; c < spec.columns.size(); ++c) {
      if (!table.has(c)) continue;
      const int joint = model.joint_index(spec.columns[c].name);
      positions.back()[joint] = table.value(c);
      if (std::isnan(table.value(c))) continue;  // told already
      if (const auto outside = outside_range(model, joint, table.value(c)))
        table.row_error("limit of " + spec.columns[c].name, c, *outside);
    }
  }
  if (!table.good()) return {};
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
