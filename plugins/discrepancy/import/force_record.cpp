#include "plugins/discrepancy/import/force_record.h"

#include <array>

#include "engine/io/csv.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/machine_column.h"
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
        table_(read_machine_table(file, diagnostics)) {}

  ForceRecord read() {
    if (diagnostics_.error_count() > before_) return {};
    ForceRecord record;
    const MachineColumn* time = table_.find({"time", "t", "timestamp", "elapsed time"});
    if (time == nullptr) {
      diagnostics_.error(table_.head, "no column is the time, expected one named Time");
      return {};
    }
    record.time = in_si(*time, Quantity::time, statements_.time_unit, "--time-unit");
    if (!record.time.empty()) check_increasing(table_, *time, diagnostics_);
    const std::array<const MachineColumn*, 3> parts = {table_.find({"fx"}), table_.find({"fy"}),
                                                       table_.find({"fz"})};
    if (parts[0] && parts[1] && parts[2] && !statements_.column)
      take_vector(parts, record);
    else
      take_one(record);
    if (statements_.extension) take_extension(record);
    return record;
  }

 private:
  void miss(const std::string& what) { notes_.missing.push_back(file_.string() + ": " + what); }
  void say(const std::string& what) {
    notes_.said.push_back(file_.filename().string() + ": " + what);
  }

  /// The values in SI units; none, with an error, where they cannot be.
  std::vector<double> in_si(const MachineColumn& column, Quantity quantity,
                            const std::optional<double>& told, const std::string& option) {
    return si_values(table_, column, quantity, {told, option}, diagnostics_, notes_);
  }

  void take_vector(const std::array<const MachineColumn*, 3>& parts, ForceRecord& record) {
    if (!statements_.axes) {
      miss(
          "fx, fy and fz are along the sensor's axes, expected --force-axes with those along the "
          "world's x, y and z (x,-z,y)");
      return;
    }
    Eigen::MatrixXd value(static_cast<Eigen::Index>(table_.lines.size()), 3);
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> values = in_si(*parts[static_cast<std::size_t>(axis)],
                                               Quantity::force, statements_.unit, "--force-unit");
      if (values.empty()) return;
      value.col(axis) = as_vector(values);
    }
    record.value = value * statements_.axes->transpose();
  }

  void take_one(ForceRecord& record) {
    const MachineColumn* column = load_column();
    if (column == nullptr) return;
    const std::vector<double> values =
        in_si(*column, Quantity::force, statements_.unit, "--force-unit");
    if (!statements_.direction)
      miss("column " + in_quotes(column->name) +
           " has no direction, expected --force-direction with that of the pull on the plant "
           "where it is positive (x, -z or 0.6,0,0.8)");
    if (values.empty() || !statements_.direction) return;
    say("force of column " + in_quotes(column->name));
    record.value = as_vector(values) * statements_.direction->transpose();
  }

  /// The one that is named; else the only one in a unit of force, or with the name of a load.
  const MachineColumn* load_column() {
    if (statements_.column) {
      const MachineColumn* named = table_.named(*statements_.column);
      if (named == nullptr)
        diagnostics_.error(table_.head, "no column " + in_quotes(*statements_.column) +
                                            ", expected one of: " + table_.names());
      return named;
    }
    std::vector<const MachineColumn*> found;
    for (const MachineColumn& column : table_.columns) {
      const auto unit = io::unit_of(column.unit);
      const bool named = io::match_column(column.name, "load").matches ||
                         io::match_column(column.name, "force").matches;
      if (unit ? unit->quantity == Quantity::force : named) found.push_back(&column);
    }
    if (found.size() == 1) return found.front();
    miss(std::string(found.empty() ? "no column" : "more than one column") +
         " is a force, expected --force-column with one of: " + table_.names());
    return nullptr;
  }

  void take_extension(ForceRecord& record) {
    const MachineColumn* column = table_.named(*statements_.extension);
    if (column != nullptr)
      record.extension = in_si(*column, Quantity::length, std::nullopt, "one in the table,");
    else
      diagnostics_.error(table_.head, "no column " + in_quotes(*statements_.extension) +
                                          ", expected one of: " + table_.names());
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
