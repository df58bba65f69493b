#pragma once

#include "plugins/discrepancy/log_import/log_tables.h"

namespace pedicel::discrepancy {

/// Writes an experiment folder: the trials' tables, the scene with its files below "model", the map
/// as "map.yaml", and experiment.yaml last. Throws io::WriteError.
void write_log_experiment(const std::filesystem::path& folder, const LogMap& map,
                          const LogScene& scene, const std::vector<LogTrial>& trials);

}  // namespace pedicel::discrepancy
