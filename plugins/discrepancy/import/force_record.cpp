#include "plugins/discrepancy/import/force_record.h"

#include <array>

#include "plugins/discrepancy/import/machine_table.h"

namespace pedicel::discrepancy {

namespace {

using io::Quantity;

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

class ForceReader {
 public:
  ForceReader(const std::filesystem::path& file, const ForceStatements& statements,
              Diagnostics& diagnostics, ImportNotes& notes)
      : file_(file),
        statements_(statements),
        diagnostics_(diagnostics),
        notes_(notes),
        before_(diagnostics.error_count()),
        table_(file, diagnostics, notes) {}

  ForceRecord read() {
    if (diagnostics_.error_count() > before_) return {};
    ForceRecord record;
    record.time = table_.times({}, {statements_.time_unit, "--time-unit"}, "Time");
    const std::array parts = {table_.find("fx"), table_.find("fy"), table_.find("fz")};
    if (parts[0] && parts[1] && parts[2] && !statements_.column)
      take_vector(parts, record);
    else
      take_one(record);
    if (statements_.extension) take_extension(record);
    return record;
  }

 private:
  void miss(const std::string& what) { notes_.missing.push_back(file_.string() + ": " + what); }

  std::vector<double> force_of(const MachineColumn& column) const {
    return table_.si_values(column, Quantity::force, {statements_.unit, "--force-unit"});
  }

  void take_vector(const std::array<const MachineColumn*, 3>& parts, ForceRecord& record) {
    if (!statements_.axes) {
      miss(
          "fx, fy and fz are along the sensor's axes, expected --force-axes with those along the "
          "world's x, y and z (x,-z,y)");
      return;
    }
    Eigen::MatrixXd value(static_cast<Eigen::Index>(table_.rows()), 3);
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> values = force_of(*parts[static_cast<std::size_t>(axis)]);
      if (values.empty()) return;
      value.col(axis) = as_vector(values);
    }
    record.value = value * statements_.axes->transpose();
  }

  void take_one(ForceRecord& record) {
    const MachineColumn* column = statements_.column
                                      ? table_.named(*statements_.column)
                                      : table_.lone_force("--force-column with one of");
    if (column == nullptr) return;
    const std::vector<double> values = force_of(*column);
    if (!statements_.direction)
      miss("column " + in_quotes(column->name) +
           " has no direction, expected --force-direction with that of the pull on the plant "
           "where it is positive (x, -z or 0.6,0,0.8)");
    if (values.empty() || !statements_.direction) return;
    notes_.said.push_back(file_.filename().string() + ": force of column " +
                          in_quotes(column->name));
    record.value = as_vector(values) * statements_.direction->transpose();
  }

  void take_extension(ForceRecord& record) {
    if (const MachineColumn* column = table_.named(*statements_.extension))
      record.extension = table_.si_values(*column, Quantity::length, {{}, "one in the table,"});
  }

  std::filesystem::path file_;
  const ForceStatements& statements_;
  Diagnostics& diagnostics_;
  ImportNotes& notes_;
  int before_;
  MachineTable table_;
};

}  // namespace

ForceRecord read_force_record(const std::filesystem::path& file, const ForceStatements& statements,
                              Diagnostics& diagnostics, ImportNotes& notes) {
  return ForceReader(file, statements, diagnostics, notes).read();
}

}  // namespace pedicel::discrepancy
