#include "app/verbs/param_sweep.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/verbosity.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv_cell.h"
#include "engine/world/settings.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

world::Scene scene_of_row(const world::Scene& scene, const io::CsvTable& table, std::size_t row) {
  world::Scene one = scene;
  one.sweep.reset();
  std::erase_if(one.expectations, [](const auto& e) { return e.over_sweep(); });
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    world::apply_override(one, table.columns[c], io::exact_number(table.rows[row][c]),
                          table.file + ":" + std::to_string(table.lines[row]) + ": ");
  return one;
}

std::string header_of(const io::CsvTable& table, const world::Scene& scene) {
  std::string text = "run,exit_code_1";
  for (const std::string& key : table.columns) text += "," + key;
  for (const world::Expectation& e : scene.expectations)
    if (!e.over_sweep()) {
      std::string of = e.fruit + e.body + e.plant + e.link;
      text += "," + io::csv_cell(e.quantity + (of.empty() ? "" : ":" + of));
    }
  return text + ",breaks_1,stretch_max_1\n";
}

int code_of(const SceneResult& run) {
  return run.exit_code == exit_unmet ? exit_ok : run.exit_code;
}

std::string line_of(const io::CsvTable& table, std::size_t row, const SceneResult& run) {
  std::string text = std::to_string(row + 1) + "," + std::to_string(code_of(run));
  for (const double value : table.rows[row]) text += "," + io::exact_number(value);
  for (const world::ExpectationResult& verdict : run.verdicts)
    text += "," + (verdict.measured.empty() ? "nan" : io::format_number(verdict.measured.front()));
  return text + "," + std::to_string(run.events.size()) + "," +
         io::format_number(run.largest_stretch) + "\n";
}

}  // namespace

io::CsvTable read_param_sweep(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  io::CsvTable table = io::read_csv(path, {false, false}, diagnostics);
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (std::count(table.columns.begin(), table.columns.begin() + static_cast<long>(c),
                   table.columns[c]) > 0)
      diagnostics.error({table.file, 1, 0}, "column " + in_quotes(table.columns[c]) +
                                                " appears twice, expected each key once");
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return table;
}

std::string folder_of_row(std::size_t row) {
  const std::string number = std::to_string(row + 1);
  return "run_" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
}

std::vector<world::Scene> scenes_of_rows(const world::Scene& scene, const io::CsvTable& table) {
  std::vector<world::Scene> scenes;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    scenes.push_back(scene_of_row(scene, table, row));
  return scenes;
}

RunOptions options_of_row(const RunOptions& options) {
  RunOptions one = options;
  one.video = false;
  one.quiet = true;
  one.log.clear(), one.events.clear(), one.save_state.clear(), one.comparison_with.reset();
  return one;
}

std::string param_sweep_csv(const world::Scene& scene, const io::CsvTable& table,
                            const std::vector<std::pair<std::size_t, SceneResult>>& runs) {
  std::string text = header_of(table, scene);
  for (const auto& [row, run] : runs) text += line_of(table, row, run);
  return text;
}

void say_row(std::size_t row, const SceneResult& run) {
  say(Verbosity::lines, "%s: exit code %d, %.2f x real time", folder_of_row(row).c_str(),
      code_of(run), run.real_time_factor());
}

SceneResult run_param_sweep(const world::Scene& scene, const io::CsvTable& table,
                            const RunOptions& options) {
  const std::vector<world::Scene> scenes = scenes_of_rows(scene, table);
  Diagnostics diagnostics;
  simulation::check_settings(scenes, options.simulation, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  SceneResult all;
  all.folder = options.out;
  stop_in_good_order();
  all.output = std::make_shared<io::OutputFolder>(options.out, files_of_a_run());
  if (!all.output->replaced().empty())
    say(Verbosity::warnings, "%s", all.output->replaced().c_str());
  std::string text = header_of(table, scene);
  for (std::size_t row = 0; row < scenes.size() && !stop_requested; ++row) {
    RunOptions one = options_of_row(options);
    one.out = all.output->file(folder_of_row(row) + "/");
    try {
      const SceneResult run = run_scene(scenes[row], one);
      text += line_of(table, row, run);
      say_row(row, run);
      if (run.exit_code == exit_unstable) all.exit_code = exit_unstable;
    } catch (const Stopped&) {
    }
    io::write_file_atomically(all.output->file("sweep.csv"), text);
  }
  if (stop_requested) all.exit_code = stop_exit_code();
  return all;
}

}  // namespace pedicel::app
