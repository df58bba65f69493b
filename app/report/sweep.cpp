#include "app/report/sweep.h"

#include <cmath>
#include <cstdio>

#include "app/report/scene_report.h"
#include "app/report/solver_comparison.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/world/settings.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

/// Reads back as the same number.
std::string text_of(double value) {
  const std::string text = io::format_number(value);
  return world::to_number(text) == value ? text : io::exact_number(value);
}

std::vector<SweepRun> run_sweep(const world::Scene& scene, const RunOptions& options,
                                io::OutputFolder* output) {
  std::vector<SweepRun> runs;
  for (const double value : scene.sweep->values) {
    RunOptions one = options_of_value(options);
    if (output) one.out = output->file(folder_of_value(scene, value) + "/");
    try {
      runs.push_back({value, run_scene(scene_of_value(scene, value), one)});
    } catch (const Stopped&) {
      break;
    }
    say_value(scene, runs.back(), options);
    if (stop_requested) break;
  }
  return runs;
}

/// Nothing where it was stopped: half of one would say what is not so.
std::optional<SolverComparison> whole_comparison(const world::Scene& scene,
                                                 const std::vector<SweepRun>& runs,
                                                 const RunOptions& options) {
  try {
    auto comparison = compare_solvers(scene, runs, options);
    if (!stop_requested) return comparison;
  } catch (const Stopped&) {
  }
  return std::nullopt;
}

}  // namespace

// "sweep detach.stretch=0.1: detach_time_s 3.33, 8.2 x real time"
void say_value(const world::Scene& scene, const SweepRun& run, const RunOptions& options) {
  if (options.quiet) return;
  std::string text = "sweep " + scene.sweep->key + "=" + text_of(run.value) + ":";
  for (const world::ExpectationResult& verdict : run.result.verdicts)
    text +=
        " " + verdict.expectation.quantity + " " +
        (verdict.measured.empty() ? "nothing" : io::format_number(verdict.measured.front(), 4)) +
        ",";
  std::fprintf(stderr, "%s %.2f x real time\n", text.c_str(), run.result.real_time_factor());
}

RunOptions options_of_value(const RunOptions& options) {
  RunOptions one = options;
  one.video = false;
  one.quiet = true;
  one.log.clear(), one.events.clear(), one.save_state.clear(), one.comparison_with.reset();
  one.watchers.clear();
  one.moving_scene.clear();
  return one;
}

std::string folder_of_value(const world::Scene& scene, double value) {
  return "sweep_" + scene.sweep->key + "=" + text_of(value);
}

world::Scene scene_of_value(const world::Scene& scene, double value) {
  world::Scene one = scene;
  world::apply_override(one, scene.sweep->key, text_of(value));
  one.sweep.reset();
  one.expectations.clear();
  const world::Expectation* measured = measured_by(scene);
  for (const world::Expectation& given : scene.expectations) {
    if (!given.over_sweep() && &given != measured) continue;
    world::Expectation expectation = given;
    expectation.test = world::Expectation::Test::above;
    expectation.low = -1.0e300;  // whatever is measured meets it; not measured (NaN) does not
    one.expectations.push_back(expectation);
  }
  return one;
}

const world::Expectation* measured_by(const world::Scene& scene) {
  for (const world::Expectation& e : scene.expectations)
    if (e.over_sweep()) return &e;
  return scene.expectations.empty() ? nullptr : &scene.expectations.front();
}

double measured_in(const world::Expectation& wanted, const SceneResult& run) {
  for (const world::ExpectationResult& verdict : run.verdicts) {
    const world::Expectation& e = verdict.expectation;
    if (e.quantity == wanted.quantity && e.fruit == wanted.fruit && e.plant == wanted.plant &&
        e.body == wanted.body && e.link == wanted.link && !verdict.measured.empty())
      return verdict.measured.front();
  }
  return std::nan("");
}

namespace {

/// An impossible value is found before the first run.
void check_values(const world::Scene& scene, const RunOptions& options) {
  std::vector<world::Scene> scenes;
  if (scene.sweep)
    for (const double value : scene.sweep->values) scenes.push_back(scene_of_value(scene, value));
  Diagnostics diagnostics;
  simulation::check_settings(scenes, options.simulation, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
}

}  // namespace

SceneResult run_with_sweep(const world::Scene& scene, const RunOptions& options) {
  check_values(scene, options);
  SceneResult result = run_scene(scene, options);
  std::vector<SweepRun> runs;
  if (scene.sweep && result.exit_code != 4 && !stop_requested)
    runs = run_sweep(scene, options, result.output.get());
  return end_sweep(scene, options, std::move(result), runs);
}

SceneResult end_sweep(const world::Scene& scene, const RunOptions& options, SceneResult result,
                      const std::vector<SweepRun>& runs) {
  for (const world::Expectation& expectation : scene.expectations) {
    if (!expectation.over_sweep()) continue;
    std::vector<double> values;
    for (const SweepRun& run : runs) values.push_back(measured_in(expectation, run.result));
    result.verdicts.push_back(world::judge_sweep(expectation, values));
    if (!options.quiet)
      std::fprintf(stderr, "%s\n", world::to_string(result.verdicts.back()).c_str());
    if (!result.verdicts.back().met && result.exit_code == 0) result.exit_code = exit_unmet;
  }
  for (const SweepRun& run : runs)
    if (run.result.exit_code == exit_unstable) result.exit_code = exit_unstable;
  std::optional<SolverComparison> comparison;
  if (!options.out.empty() && options.comparison && !stop_requested)
    comparison = whole_comparison(scene, runs, options);
  if (stop_requested) {
    result.exit_code = stop_exit_code();
    if (result.error.empty()) result.error = Stopped().what();
  }
  if (!result.output) return result;
  write_scene_report(scene, result, runs, comparison);
  return result;
}

}  // namespace pedicel::app
