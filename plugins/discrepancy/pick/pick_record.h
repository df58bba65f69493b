#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/import/world_tracks.h"

namespace pedicel::discrepancy {

/// A wrist's force over the time of one pick.
struct PickRecord {
  std::string file;                  ///< as it was named
  std::vector<double> time;          ///< s, increasing
  Eigen::MatrixXd force;             ///< N, samples x 1 to 3 axes of the sensor; NaN where missing
  std::vector<std::string> columns;  ///< that the axes were read from
};

/// What the person says of the table.
struct PickColumns {
  std::optional<std::string> time;   ///< name of the column (--time-column)
  std::vector<std::string> force;    ///< names of one to three columns (--force-column)
  std::optional<double> time_unit;   ///< s (--time-unit)
  std::optional<double> force_unit;  ///< N (--force-unit)
};

/// Reads a table with a time and a force along one to three axes; moments are passed over. Without
/// names the columns fx, fy, fz count, or the only column that is a force. Faults of the file go to
/// the diagnostics, what nobody states to notes.missing; what comes back then is of no use. Throws
/// InvalidFile where the file cannot be read.
PickRecord read_pick_record(const std::filesystem::path& file, const PickColumns& columns,
                            Diagnostics& diagnostics, ImportNotes& notes);

}  // namespace pedicel::discrepancy
