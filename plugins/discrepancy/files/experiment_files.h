#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Told before each trial is read, and at the end: how many were, of how many. False: read no more.
using ReadProgress = std::function<bool(int done, int all)>;

struct ReadOptions {
  /// The file of another scene to take in place of the experiment's own; what the experiment names
  /// must be there, too.
  std::filesystem::path scene{};
  ReadProgress progress{};
};

/// Reads an experiment folder (or its experiment.yaml). Every fault goes to `diagnostics` with
/// file, line and column; nothing comes back where there is one, or where it was told to stop.
std::optional<Experiment> read_experiment(const std::filesystem::path& path,
                                          Diagnostics& diagnostics,
                                          const ReadOptions& options = {});

/// Writes it as a folder that read_experiment() reads back, each trial in a folder of its name,
/// with the plant file, or with all files of the scene: below `model` where they are not all below
/// the scene's folder. Throws io::WriteError, and UsageError where the scene's path leads out of
/// the folder.
void write_experiment(const std::filesystem::path& folder, const Experiment& experiment);

/// The tables of a trial that have rows, and its events, into its folder. Throws io::WriteError.
void write_tables(const std::filesystem::path& folder, const Experiment& experiment,
                  const Trial& trial);

}  // namespace pedicel::discrepancy
