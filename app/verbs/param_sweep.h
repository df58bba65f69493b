#pragma once

#include <filesystem>

#include "app/report/headless.h"
#include "engine/io/csv.h"

namespace pedicel::app {

/// Reads the table of `--param-sweep FILE.csv`: its columns are keys as of `--set`, each row is a
/// run. Throws InvalidFile.
io::CsvTable read_param_sweep(const std::filesystem::path& path);

/// One scene a row. Throws UsageError for a key or a value that is impossible.
std::vector<world::Scene> scenes_of_rows(const world::Scene& scene, const io::CsvTable& table);
/// How a row's run is done: alone, quietly, without video.
RunOptions options_of_row(const RunOptions& options);
/// "run_001", of the first row.
std::string folder_of_row(std::size_t row);

/// sweep.csv of the rows that were run: by their number in the table, from 0 on.
std::string param_sweep_csv(const world::Scene& scene, const io::CsvTable& table,
                            const std::vector<std::pair<std::size_t, SceneResult>>& runs);

/// The line that tells of one row, where the program says as much.
void say_row(std::size_t row, const SceneResult& run);

/// Runs a scene once for each row, into the folders run_001, run_002, ... of `options.out`, without
/// video, and writes sweep.csv beside them: the row, the exit code of its run, what the scene
/// expects something of, as measured. What is expected is not judged: that is of the scene's own
/// values. Exit code 4 where a run is unstable. Throws UsageError for a key or a value that is
/// impossible, before anything runs.
SceneResult run_param_sweep(const world::Scene& scene, const io::CsvTable& table,
                            const RunOptions& options);

}  // namespace pedicel::app
