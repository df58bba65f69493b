#pragma once

#include "app/verbs/import.h"

namespace pedicel::app {

/// Whether the files of an import are logs of a robot (MCAP, bags of ROS 1). Throws UsageError
/// where only some are.
bool are_logs(const ImportArguments& arguments);

/// `pedicel import LOG.mcap...`: an experiment whose model is a scene. Without --map a first map is
/// proposed and written into the folder; with it, and without, where the proposal is enough, the
/// tables. Returns the exit code as import_verb(). Throws as that does.
int import_log_verb(const ImportArguments& arguments);

}  // namespace pedicel::app
