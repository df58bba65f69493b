#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/world_tracks.h"

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

/// What the person says of a column's unit.
struct StatedColumnUnit {
  std::optional<double> factor;  ///< in SI units, where it was said
  std::string option;            ///< that says it: "--force-unit"
};

/// Such a table: lines about the test, which are passed over, a line of names with a time among
/// them, a row of units or none, rows. Faults go to the diagnostics, what nobody states to
/// notes.missing, and what comes back then is empty. Keeps references to both.
class MachineTable {
 public:
  /// Throws InvalidFile where the file cannot be read.
  MachineTable(const std::filesystem::path& file, Diagnostics& diagnostics, ImportNotes& notes);

  const std::vector<MachineColumn>& columns() const { return columns_; }
  std::size_t rows() const { return lines_.size(); }
  /// The first column of that name, whatever its capitals and its unit; nullptr: none.
  const MachineColumn* find(const char* name) const;
  /// The column of exactly this name, with its unit or without; nullptr, with an error: none.
  const MachineColumn* named(const std::string& name) const;
  /// The only one in a unit of force, or with the name of a load; nullptr, with a note, where there
  /// is none or several. `option` says which it is: "--force-column with one of".
  const MachineColumn* lone_force(const std::string& option) const;
  /// "Time (s)", "Load": for an error.
  std::string names() const;
  /// At the line of the names.
  void error(const std::string& what) const { diagnostics_.error(head_, what); }

  /// The values in SI units.
  std::vector<double> si_values(const MachineColumn& column, io::Quantity quantity,
                                const StatedColumnUnit& stated) const;
  /// Those of the time: of the column `named`, else of one with such a name. They increase.
  /// `expected` ends the sentence where there is none.
  std::vector<double> times(const std::optional<std::string>& named, const StatedColumnUnit& stated,
                            const std::string& expected) const;

 private:
  void check_increasing(const MachineColumn& time) const;

  Diagnostics& diagnostics_;
  ImportNotes& notes_;
  std::vector<MachineColumn> columns_;
  std::vector<int> lines_;  ///< of the rows
  SourcePosition head_;     ///< of the names
};

}  // namespace pedicel::discrepancy
