#include "pedicel/app/report/scene_report.h"

#include <cmath>
#include <cstdio>

#include "pedicel/app/report/log_plots.h"
#include "pedicel/app/report/run_report.h"
#include "pedicel/app/report/version.h"
#include "pedicel/io/atomic_file.h"

namespace pedicel::app {

namespace {

std::string number(double value, int digits = 4) {
  return io::format_number(value, digits);
}

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
  return text;
}

std::vector<ReportExpectation> expectations_of(const SceneResult& result) {
  std::vector<ReportExpectation> all;
  for (const world::ExpectationResult& verdict : result.verdicts)
    all.push_back({world::to_string(verdict.expectation), joined(verdict.measured), verdict.met});
  if (result.comparison)
    for (const ColumnComparison& one : result.comparison->columns)
      all.push_back({one.column + " within " + number(result.comparison->tolerance) + " of " +
                         result.comparison->measured.filename().string(),
                     "largest " + number(one.largest) + ", rms " + number(one.rms), one.within});
  return all;
}

ReportTable events_of(const SceneResult& result) {
  ReportTable table;
  if (result.events.empty()) return table;
  table.header = {"time (s)",   "organ",     "cause",         "stretch",
                  "bend (rad)", "force (N)", "moment (mN m)", "angle to the vertical (deg)"};
  for (const world::Event& e : result.events)
    table.rows.push_back({number(e.time), e.organ, e.cause, number(e.stretch), number(e.bend),
                          number(e.force), number(1.0e3 * e.moment),
                          number(e.angle * 180.0 / 3.14159265358979323846)});
  return table;
}

std::vector<io::LinePlot> plots_of(const SceneResult& result) {
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(result.folder / "log.csv", {true, true}, diagnostics);
  std::vector<io::PlotEvent> events;
  for (const world::Event& e : result.events) events.push_back({e.time, e.organ + " off"});
  return log_plots(log, result.limits, events);
}

/// The picture of a run that shows most: the last one just before a break, else the last.
std::optional<std::filesystem::path> telling_picture(const SceneResult& run) {
  std::optional<std::filesystem::path> best;
  for (const std::filesystem::path& picture : run.pictures) {
    const auto is_break = [](const std::filesystem::path& p) {
      return p.filename().string().starts_with("before_break");
    };
    if (!best || !is_break(*best) || is_break(picture)) best = picture;
  }
  return best;
}

void add_sweep(const world::Scene& scene, const std::vector<SweepRun>& sweep,
               io::OutputFolder& output, RunSummary& summary) {
  if (sweep.empty()) return;
  const world::Expectation* by = measured_by(scene);
  const std::string measured = by ? by->quantity : "state hash";
  summary.sweep.header = {scene.sweep->key, measured, "breaks", "largest stretch",
                          "real-time factor"};
  std::string csv =
      scene.sweep->key + "," + measured + ",breaks_1,stretch_max_1,real_time_factor_1\n";
  std::vector<double> values, results;
  for (const SweepRun& run : sweep) {
    values.push_back(run.value);
    results.push_back(by ? measured_in(*by, run.result) : std::nan(""));
    const std::vector<std::string> row = {
        number(run.value, 6), number(results.back()), std::to_string(run.result.events.size()),
        number(run.result.largest_stretch), number(run.result.real_time_factor(), 3)};
    summary.sweep.rows.push_back(row);
    for (std::size_t i = 0; i < row.size(); ++i) csv += (i ? "," : "") + row[i];
    csv += '\n';
    if (const auto picture = telling_picture(run.result))
      summary.sweep_pictures.push_back({*picture, scene.sweep->key + " = " + number(run.value, 6)});
  }
  if (by) summary.sweep_plot = sweep_plot(scene.sweep->key, values, measured, results);
  summary.files.emplace_back("sweep.csv", "the sweep's values and what was measured");
  io::write_file_atomically(output.file("sweep.csv"), csv);
}

void add_comparison(const SolverComparison& comparison, io::OutputFolder& output,
                    RunSummary& summary) {
  const std::string& quantity = comparison.quantity;
  summary.solvers.header = {"sampling.distance (m)", quantity + ", direct solver",
                            quantity + ", position-based solver"};
  for (const SolverComparison::Row& row : comparison.rows)
    summary.solvers.rows.push_back(
        {number(row.distance, 6), number(row.direct), number(row.position_based)});
  summary.solver_speeds.header = {"solver", "sub-steps", quantity, "error", "real-time factor"};
  for (const SolverComparison::Speed& speed : comparison.speeds)
    summary.solver_speeds.rows.push_back({speed.solver, std::to_string(speed.substeps),
                                          number(speed.measured), number(speed.error, 3),
                                          number(speed.real_time_factor, 3)});
  summary.solver_note =
      "Error: from what the direct solver finds with " + number(comparison.fine_distance, 6) +
      " m between nodes, " + number(comparison.fine) + ". " +
      (comparison.equal ? "The last two lines are as good as the direct solver, within a tenth."
                        : "The position-based solver does not become as good as the direct one.");
  summary.files.emplace_back("solvers.csv", "both solvers over the sweep, and at equal error");
  io::write_file_atomically(output.file("solvers.csv"), to_csv(comparison));
}

std::vector<std::pair<std::string, std::string>> numbers_of(const SceneResult& result) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(result.state_hash));
  std::vector<std::pair<std::string, std::string>> all = {
      {"steps", std::to_string(result.steps)},
      {"simulated", number(result.simulated) + " s"},
      {"wall time of the steps", number(result.wall, 3) + " s"},
      {"real-time factor", number(result.real_time_factor(), 3)},
      {"a step, median", number(result.ms_per_step_p50, 3) + " ms"},
      {"a step, 95th percentile", number(result.ms_per_step_p95, 3) + " ms"},
      {"largest stretch", number(result.largest_stretch)},
      {"state hash", hash}};
  if (!result.residual.empty()) all.emplace_back("standing as drawn", result.residual);
  return all;
}

std::vector<std::pair<std::string, std::string>> settings_of(const world::Scene& scene) {
  std::vector<std::pair<std::string, std::string>> all = {
      {"dt", number(scene.dt, 6) + " s"},
      {"seed", std::to_string(scene.seed)},
      {"threads", std::to_string(scene.threads)}};
  for (const world::Setting& s : scene.rods) all.emplace_back("rods." + s.key, s.text);
  for (const world::Setting& s : scene.coupling) all.emplace_back("coupling." + s.key, s.text);
  for (const world::ScenePlant& plant : scene.plants)
    for (const world::Setting& s : plant.set) all.emplace_back(plant.name + "." + s.key, s.text);
  return all;
}

}  // namespace

void write_scene_report(const world::Scene& scene, const SceneResult& result,
                        const std::vector<SweepRun>& sweep,
                        const std::optional<SolverComparison>& comparison) {
  RunSummary summary;
  summary.title = scene.name;
  summary.purpose = scene.purpose;
  summary.see = scene.see;
  summary.error = result.error;
  summary.expectations = expectations_of(result);
  if (result.video)
    summary.video = std::filesystem::relative(*result.video, result.folder).string();
  for (const std::filesystem::path& picture : result.pictures)
    summary.pictures.push_back({picture, picture.stem().string()});
  summary.events = events_of(result);
  summary.plots = plots_of(result);
  summary.numbers = numbers_of(result);
  summary.settings = settings_of(scene);
  summary.files = {{"log.csv", "everything that was recorded, over time"},
                   {"events.csv", "the fruits that came off"},
                   {"log.meta.json", "version, seed, settings and state hash of this run"}};
  add_sweep(scene, sweep, *result.output, summary);
  if (comparison) add_comparison(*comparison, *result.output, summary);
  summary.machine = "pedicel " + version() + " (" + git_hash() + ") on " + machine();
  write_run_report(summary, result.output->file("report.html"));
}

}  // namespace pedicel::app
