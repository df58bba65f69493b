#pragma once

#include <optional>

#include "app/report/sweep.h"
#include "engine/cluster/cluster_options.h"
#include "engine/core/files_read.h"
#include "engine/io/csv.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// What a sweep consists of. With values: case 0 is the scene's own run, the next ones are the
/// values. With a table: its rows.
class SweepCases {
 public:
  /// All must outlive it. Throws UsageError for a row with an impossible key or value.
  SweepCases(const world::Scene& scene, const std::optional<io::CsvTable>& table,
             const RunOptions& options);

  int size() const;
  const world::Scene& scene() const { return scene_; }
  const RunOptions& options() const { return options_; }
  const io::CsvTable* table() const { return table_ ? &*table_ : nullptr; }
  /// The folder of its run below the sweep's: "sweep_dt=0.01", "run_001"; empty: the sweep's own.
  std::string folder(int number) const;
  world::Scene scene_of(int number) const;
  RunOptions options_of(int number) const;

 private:
  const world::Scene& scene_;
  const std::optional<io::CsvTable>& table_;
  const RunOptions& options_;
  std::vector<world::Scene> rows_;
};

/// What a task does: one case, into the folder of the options, with its result as a file. Returns
/// the exit code. Throws UsageError where there is no such case, and what run_scene() throws.
int run_case_of(const SweepCases& cases, int number);

/// The cases as tasks, and what is there of their results put together as a sweep without tasks
/// leaves it. `inputs` knows the files of the scene. Exit code 1 where cases are missing.
SceneResult run_as_tasks(const SweepCases& cases, const CLI::App& verb,
                         const cluster::ClusterOptions& options, const FilesRead& inputs,
                         bool quiet);

}  // namespace pedicel::app
