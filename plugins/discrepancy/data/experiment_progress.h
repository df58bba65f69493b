#pragma once

#include <functional>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Told before each trial is read, and at the end: how many were, of how many. False: read no more.
using ReadProgress = std::function<bool(int done, int all)>;

/// read_experiment() that tells how far it is. Nothing comes back where it was told to stop.
std::optional<Experiment> read_experiment(const std::filesystem::path& path,
                                          Diagnostics& diagnostics, const ReadProgress& progress);

}  // namespace pedicel::discrepancy
