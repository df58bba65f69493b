#include "plugins/discrepancy/import/machine_column.h"

#include <cmath>
#include <filesystem>

namespace pedicel::discrepancy {

std::vector<double> si_values(const MachineTable& table, const MachineColumn& column,
                              io::Quantity quantity, const StatedColumnUnit& stated,
                              Diagnostics& diagnostics, ImportNotes& notes) {
  const auto unit = io::unit_of(column.unit);
  const std::string name = "column " + in_quotes(column.name);
  if (!column.fault.what.empty()) {
    diagnostics.error(column.fault.where, column.fault.what);
    return {};
  }
  if (!stated.factor && column.unit.empty()) {
    notes.missing.push_back(table.head.file + ": " + name + " has no unit, expected " +
                            stated.option + " with " + io::units_of(quantity));
    return {};
  }
  if (!stated.factor && (!unit || unit->quantity != quantity)) {
    diagnostics.error(column.where, name + " is in " + in_quotes(column.unit) + ", expected " +
                                        io::units_of(quantity));
    return {};
  }
  if (stated.factor && unit && unit->factor != *stated.factor)
    notes.said.push_back(std::filesystem::path(table.head.file).filename().string() +
                         ": warning: " + name + " is in " + in_quotes(column.unit) + ", and " +
                         stated.option + " says otherwise, which counts");
  std::vector<double> values = column.values;
  for (double& value : values) value *= stated.factor ? *stated.factor : unit->factor;
  return values;
}

bool check_increasing(const MachineTable& table, const MachineColumn& column,
                      Diagnostics& diagnostics) {
  const std::vector<double>& time = column.values;
  for (std::size_t r = 0; r < time.size(); ++r)
    if (std::isnan(time[r]) || (r > 0 && time[r] <= time[r - 1])) {
      diagnostics.error({table.head.file, table.lines[r], column.columns[r]},
                        "time does not increase here, expected one recording in time");
      return false;
    }
  return true;
}

}  // namespace pedicel::discrepancy
