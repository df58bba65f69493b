#pragma once

#include "app/dataset/data_set.h"
#include "engine/cluster/cluster_options.h"
#include "engine/core/files_read.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// Pictures of one case. Each needs a simulation of its own; a case is a process, which reads the
/// scene first.
inline constexpr long pictures_of_case = 10;

/// The options of one case, for `--part`. Throws UsageError where there is no such case.
DataSetOptions options_of_part(DataSetOptions options, int part);

/// The pictures as tasks, and what is there of them put together as a run without tasks leaves it.
/// `inputs` knows the files of the scene. `whole` becomes false where cases are missing.
DataSetResult make_data_set_as_tasks(const DataSetOptions& options, const CLI::App& verb,
                                     const cluster::ClusterOptions& cluster,
                                     const FilesRead& inputs, bool& whole);

}  // namespace pedicel::app
