#include "app/report/scene_report.h"

#include <cmath>
#include <cstdio>

#include "app/report/log_plots.h"
#include "app/report/run_report.h"
#include "app/report/version.h"
#include "engine/core/joined.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

std::string number(double value, int digits = 4) {
  return io::format_number(value, digits);
}

std::vector<ReportExpectation> expectations_of(const SceneResult& result) {
  std::vector<ReportExpectation> all;
  for (const world::ExpectationResult& verdict : result.verdicts)
    all.push_back({world::to_string(verdict.expectation),
                   joined(verdict.measured, [](double value) { return number(value); }),
                   verdict.met});
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

/// The sum of all, then what was touched or broke.
ReportTable gentleness_of(const SceneResult& result) {
  ReportTable table;
  const simulation::Gentleness::Total& all = result.gentleness;
  if (all.touched == 0 && all.broken == 0) return table;
  table.header = {"organ",       "peak force (N)",     "impulse (N s)",
                  "margin used", "strain energy (mJ)", "first touched (s)",
                  "broken"};
  table.rows.push_back({"all", number(all.peak_force), number(all.impulse), number(all.margin_used),
                        number(1.0e3 * all.strain_energy), std::to_string(all.touched) + " touched",
                        std::to_string(all.broken) + " fruits"});
  for (const HandledOrgan& one : result.handled) {
    const simulation::Gentleness::Record& r = one.record;
    if (!r.touched() && !r.broken) continue;
    table.rows.push_back({one.name, number(r.peak_force), number(r.impulse),
                          one.fruit ? number(r.margin_used) : "",
                          one.fruit ? "" : number(1.0e3 * r.strain_energy),
                          r.touched() ? number(r.first_touch) : "", r.broken ? "broken" : ""});
  }
  return table;
}

/// What a sweep over pull directions found: the force in the stalk that broke first.
std::optional<plots::PolarPlot> polar_of(const world::Scene& scene,
                                         const std::vector<SweepRun>& sweep) {
  const std::string& key = scene.sweep->key;
  if (key != "loads.angle" && key != "loads.azimuth") return {};
  plots::PolarPlot plot;
  plot.title = "Force at detachment over the pull's direction";
  plot.label = key == "loads.angle" ? "force in the stalk (N); 0\u00b0 pulls down"
                                    : "force in the stalk (N); 0\u00b0 pulls along X";
  for (const SweepRun& run : sweep) {
    plot.angle.push_back(run.value);
    plot.value.push_back(run.result.events.empty() ? std::nan("")
                                                   : run.result.events.front().force);
  }
  return plot;
}

std::vector<plots::LinePlot> plots_of(const SceneResult& result) {
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(result.folder / "log.csv", {true, true}, diagnostics);
  std::vector<plots::PlotEvent> events;
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
  summary.sweep_polar = polar_of(scene, sweep);
  if (summary.sweep_polar) {
    summary.files.emplace_back("polar.svg", "the force at detachment over the pull's direction");
    io::write_file_atomically(output.file("polar.svg"), to_svg(*summary.sweep_polar));
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
  summary.moving_scene = result.moving_scene;
  for (const std::filesystem::path& picture : result.pictures)
    summary.pictures.push_back({picture, picture.stem().string()});
  summary.events = events_of(result);
  summary.gentleness = gentleness_of(result);
  summary.plots = plots_of(result);
  summary.numbers = numbers_of(result);
  summary.settings = settings_of(scene);
  summary.files = {{"log.csv", "everything that was recorded, over time"},
                   {"events.csv", "the fruits that came off"},
                   {"gentleness.csv", "how hard each organ was touched, and what broke"},
                   {"log.meta.json", "version, seed, settings and state hash of this run"}};
  add_sweep(scene, sweep, *result.output, summary);
  if (comparison) add_comparison(*comparison, *result.output, summary);
  summary.machine = "pedicel " + version() + " (" + git_hash() + ") on " + machine();
  write_run_report(summary, result.output->file("report.html"));
}

}  // namespace pedicel::app
