#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/report/compare.h"
#include "app/report/gentleness_table.h"
#include "app/report/log_plots.h"
#include "app/report/run_watcher.h"
#include "engine/io/output_folder.h"
#include "engine/world/recorder.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A comparison with measured values that a run is to end with.
struct ComparisonRequest {
  io::CsvTable measured;
  double tolerance = 0.0;  ///< in each column's own unit
};

struct RunOptions {
  simulation::SimulationOptions simulation;
  std::filesystem::path out;          ///< folder; empty: nothing is written
  std::filesystem::path log, events;  ///< copies of log.csv and events.csv; empty: none
  std::optional<long> steps;          ///< to be done, in place of the scene's duration
  std::filesystem::path
      save_state;  ///< written at the end, also of a run that is stopped; empty: not
  std::filesystem::path load_state;  ///< the run goes on from there; empty: from the beginning
  std::optional<ComparisonRequest> comparison_with;
  std::vector<MakeWatcher> watchers;   ///< who looks at the run besides; of a sweep's main run only
  std::filesystem::path moving_scene;  ///< GLB that a watcher writes, for the report; empty: none
  bool pictures = true;
  bool video = true;
  bool comparison = true;     ///< compare_solvers(), where the scene's sweep is one for it
  std::optional<double> fps;  ///< Hz, in place of the scene's
  std::optional<std::array<int, 2>> size;  ///< px, in place of the scene's
  bool quiet = false;                      ///< no start line, end line and progress
};

/// What a run leaves behind, beside its files.
struct SceneResult {
  int exit_code = 0;
  long steps = 0;
  double simulated = 0.0, wall = 0.0;  ///< s; wall: the steps alone
  double ms_per_step_p50 = 0.0, ms_per_step_p95 = 0.0;
  double largest_stretch = 0.0;  ///< 1
  std::uint64_t state_hash = 0;
  std::string residual;  ///< worst_residual() of its plants
  std::string error;     ///< why it ended early; empty: it did not
  std::vector<world::ExpectationResult> verdicts;
  std::optional<Comparison> comparison;  ///< with measured values
  std::vector<world::Event> events;
  simulation::Gentleness::Total gentleness;
  std::vector<HandledOrgan> handled;            ///< one by one
  std::vector<StalkLimits> limits;              ///< of every fruit, for the plots
  std::vector<std::filesystem::path> pictures;  ///< in the order taken
  std::optional<std::filesystem::path> video;
  std::filesystem::path moving_scene;  ///< GLB; empty: none
  std::filesystem::path folder;
  std::shared_ptr<io::OutputFolder> output;  ///< taken for the run; null: nothing is written

  double real_time_factor() const { return wall > 0.0 ? simulated / wall : 0.0; }
};

/// What every run may write into its folder, beside its pictures.
const std::vector<std::string>& files_of_a_run();

/// The lines on standard error that end a run: steps, speed, breaks and state, then what was
/// expected. Not where `options` are quiet, or the program is.
void say_result(const SceneResult& result, const RunOptions& options);

/// Runs a scene off screen, once, without its sweep: steps it, records it, takes its pictures and
/// its video, and judges its expectations (those over a sweep are left out). Throws InvalidFile for
/// a scene that cannot be built, Stopped while it is built, and io::WriteError for an output that
/// cannot be written. Where stop_requested it ends with its files closed (stop_exit_code()).
SceneResult run_scene(const world::Scene& scene, const RunOptions& options);

/// Runs a scene, and its sweep where it has one (each value in a folder of its own, without video),
/// and writes report.html. The result is that of the main run with the sweep's verdicts added.
SceneResult run_with_sweep(const world::Scene& scene, const RunOptions& options);

/// A result for machines.
std::string to_json(const world::Scene& scene, const SceneResult& result);

}  // namespace pedicel::app
