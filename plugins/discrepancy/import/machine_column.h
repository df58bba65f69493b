#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/machine_table.h"
#include "plugins/discrepancy/import/world_tracks.h"

namespace pedicel::discrepancy {

/// What the person says of a column's unit.
struct StatedColumnUnit {
  std::optional<double> factor;  ///< in SI units, where it was said
  std::string option;            ///< that says it: "--force-unit"
};

/// The values of a column in SI units. A cell that is no number and a unit of something else go to
/// the diagnostics; a unit that nobody states to notes.missing. Both come back as no values.
std::vector<double> si_values(const MachineTable& table, const MachineColumn& column,
                              io::Quantity quantity, const StatedColumnUnit& stated,
                              Diagnostics& diagnostics, ImportNotes& notes);

/// False, with an error, where time is missing in a row or does not increase.
bool check_increasing(const MachineTable& table, const MachineColumn& column,
                      Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
