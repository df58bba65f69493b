#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "plugins/discrepancy/import/world_tracks.h"

namespace pedicel::discrepancy {

/// What the person says of a force table.
struct ForceStatements {
  std::optional<std::string>
      column;                       ///< of the force, where the table has several (--force-column)
  std::optional<double> unit;       ///< N (--force-unit)
  std::optional<double> time_unit;  ///< s (--time-unit)
  std::optional<Vec3> direction;    ///< W, unit: of the pull where the column is positive
  std::optional<Mat3> axes;         ///< of tables with fx, fy, fz: into the world
  std::optional<std::string> extension;  ///< column of the machine's way (--extension-column)
};

/// A force over time in the world.
struct ForceRecord {
  std::vector<double> time;  ///< s, on the table's clock
  Eigen::MatrixXd value;     ///< N, W; samples x 3, the pull on the plant; NaN where not measured
  std::vector<double> extension;  ///< m, of the machine; empty where it is not asked for
};

/// Reads a table with a time and a load, or with fx, fy and fz: one line of names, a line of units
/// below it or units behind the names. Faults of the file go to the diagnostics; what nobody states
/// to notes.missing. What comes back then is of no use. Throws InvalidFile where it cannot be read.
ForceRecord read_force_record(const std::filesystem::path& file, const ForceStatements& statements,
                              Diagnostics& diagnostics, ImportNotes& notes);

}  // namespace pedicel::discrepancy
