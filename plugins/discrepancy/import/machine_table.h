#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::discrepancy {

/// A column of a table as a testing machine or a sensor's program writes it.
struct MachineColumn {
  std::string name;            ///< as written
  std::string unit;            ///< from the row below or behind the name; empty where none is said
  SourcePosition where;        ///< of the name
  std::vector<double> values;  ///< in that unit; NaN where missing or no number
  std::vector<int> columns;    ///< where each value begins in its line
  Diagnostic fault;  ///< of the first cell that is no number; said once the column is used
};

/// Such a table: lines about the test, which are passed over, a line of names with a time among
/// them, a row of units or none, rows.
struct MachineTable {
  std::vector<MachineColumn> columns;
  std::vector<int> lines;  ///< of the rows
  SourcePosition head;     ///< of the names

  /// The first column with one of these names, whatever its capitals and its unit; nullptr: none.
  const MachineColumn* find(std::initializer_list<const char*> names) const;
  /// The column of exactly this name, with its unit or without; nullptr: none.
  const MachineColumn* named(const std::string& name) const;
  /// "Time (s)", "Load": for an error.
  std::string names() const;
};

/// Faults of the table as a whole go to the diagnostics. Throws InvalidFile.
MachineTable read_machine_table(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
