#pragma once

#include <filesystem>

#include "app/report/run_watcher.h"

namespace pedicel::app {

/// What writes the topics of a run to an HDF5 file, at the scene's log_rate: a group a topic, and
/// in it `time` (s, of the message's own stamp) and a data set a value, one row a message.
/// Throws UsageError in a program that was built without HDF5.
MakeWatcher h5_log(const std::filesystem::path& file);

}  // namespace pedicel::app
