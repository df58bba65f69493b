#include "app/verbs/sweep.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "app/report/sweep.h"
#include "app/verbs/cluster.h"
#include "app/verbs/effective_scene.h"
#include "app/verbs/param_sweep.h"
#include "app/verbs/run_arguments.h"
#include "app/verbs/sweep_tasks.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/files_read.h"
#include "engine/core/verbosity.h"
#include "engine/world/settings.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

struct SweepArguments : RunArguments {
  cluster::ClusterOptions cluster;
  int part = -1;  // of the cases that --cluster hands in
};

/// The one of --set with several values; taken out of `set`.
std::optional<world::SceneSweep> take_sweep(std::vector<std::string>& set) {
  std::optional<world::SceneSweep> sweep;
  std::vector<std::string> plain;
  for (const std::string& assignment : set) {
    const auto [key, values] = world::split_assignment(assignment);
    if (values.find(',') == std::string::npos) {
      plain.push_back(assignment);
      continue;
    }
    if (sweep) throw UsageError("--set " + key + ": expected one key with several values");
    sweep = world::SceneSweep{key, {}, {}};
    for (std::size_t start = 0; start <= values.size();) {
      const std::size_t end = std::min(values.find(',', start), values.size());
      const auto value = world::to_number(values.substr(start, end - start));
      if (!value) throw UsageError("--set " + assignment + ": expected numbers between the commas");
      if (std::ranges::count(sweep->values, *value) > 0)
        throw UsageError("--set " + assignment + ": a value comes twice, expected each once");
      sweep->values.push_back(*value);
      start = end + 1;
    }
  }
  set = plain;
  return sweep;
}

/// An impossible key or value is found before the first run.
void check_all(const std::vector<world::Scene>& scenes, const RunOptions& options) {
  Diagnostics diagnostics;
  simulation::check_settings(scenes, options.simulation, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
}

std::vector<world::Scene> scenes_of_values(const world::Scene& scene,
                                           const world::SceneSweep& sweep) {
  std::vector<world::Scene> scenes;
  for (const double value : sweep.values) {
    scenes.push_back(scene);
    world::apply_override(scenes.back(), sweep.key, io::exact_number(value), "--set ");
  }
  return scenes;
}

void check_arguments(const SweepArguments& a) {
  check_run_arguments(a);
  if (!a.load_state.empty()) throw UsageError("sweep: expected no --load-state");
  if (!a.cluster.wanted() && a.part < 0) return;
  a.refuse({"--log", "--events", "--gltf", "--compare", "--save-state"},
           "is of one run, expected it without --cluster");
}

int run(SweepArguments a, const CLI::App& verb) {
  a.cluster = cluster::with_profile(a.cluster);
  check_arguments(a);
  apply_verbosity(a);
  std::optional<FilesRead> inputs;
  if (a.cluster.wanted()) inputs.emplace();
  const std::optional<world::SceneSweep> sweep = take_sweep(a.set);
  if (sweep.has_value() == !a.param_sweep.empty())
    throw UsageError("sweep: expected either --set key=value,value,... or --param-sweep TABLE");
  const RunOptions options = options_of_run(a);
  world::Scene scene = load_scene(a);
  std::optional<io::CsvTable> table;
  if (sweep) {
    if (scene.sweep && scene.sweep->key != sweep->key)
      std::erase_if(scene.expectations, [](const auto& e) { return e.over_sweep(); });
    check_all(scenes_of_values(scene, *sweep), options);
    scene.sweep = sweep;
  } else {
    table = read_param_sweep(a.param_sweep);
    check_all(scenes_of_rows(scene, *table), options);
  }
  if (a.print_scene) {
    std::cout << effective_scene(scene) << std::flush;
    return exit_ok;
  }
  const SweepCases cases(scene, table, options);
  if (a.part >= 0) return run_case_of(cases, a.part);
  if (a.cluster.wanted())
    return end_of_run(scene, a, options, run_as_tasks(cases, verb, a.cluster, *inputs, a.quiet));
  return end_of_run(
      scene, a, options,
      table ? run_param_sweep(scene, *table, options) : run_with_sweep(scene, options));
}

}  // namespace

std::function<int()> add_sweep_verb(CLI::App& app) {
  const auto a = std::make_shared<SweepArguments>();
  CLI::App* verb = app.add_subcommand("sweep", "run a scene for several values of one setting");
  finds_shipped(verb->add_option("scene", a->scene, "scene file"))->required();
  add_run_options(*verb, *a);
  cluster::add_cluster_options(*verb, a->cluster);
  verb->add_option("--part", a->part, "only this one of the cases: what a task of --cluster calls")
      ->check(CLI::NonNegativeNumber);
  return [a, verb] { return run(*a, *verb); };
}

}  // namespace pedicel::app
