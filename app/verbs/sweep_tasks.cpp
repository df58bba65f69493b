#include "app/verbs/sweep_tasks.h"

#include <CLI/CLI.hpp>

#include "app/report/result_file.h"
#include "app/verbs/cluster.h"
#include "app/verbs/param_sweep.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/verbosity.h"
#include "engine/io/atomic_file.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* result_file = "result.json";

/// What a run tells by its exit code, and no failure of it.
const std::vector<int> results_of_runs = {exit_ok, exit_unstable, exit_unmet, exit_no_pictures};

cluster::Plan plan_of(const SweepCases& cases, const CLI::App& verb, const FilesRead& inputs,
                      const std::string& instruction_set) {
  cluster::Plan plan;
  plan.verb = verb.get_name();
  plan.common = cluster::words_of(verb, {"--out", "--json", "--quiet", "-v", "--instruction-set"});
  plan.common.insert(plan.common.end(), {"--quiet", "--out={out}"});
  plan.again = cluster::words_of_same_call(verb);
  plan.inputs = inputs.files();
  plan.results = results_of_runs;
  plan.instruction_set = instruction_set;
  plan.threads = std::max(1, cases.scene().threads);
  for (int i = 0; i < cases.size(); ++i) {
    const std::string folder = cases.folder(i);
    plan.cases.push_back(
        {folder.empty() ? "the scene itself" : folder, {"--part=" + std::to_string(i)}});
  }
  return plan;
}

/// A run's files under its own name, as if it had been made there.
SceneResult placed(const SweepCases& cases, int number, const fs::path& from,
                   std::shared_ptr<io::OutputFolder> to) {
  SceneResult result = read_result(from / result_file, cases.scene_of(number).expectations);
  place_files(from, *to, result_file);
  for (fs::path& picture : result.pictures) picture = to->path() / picture.lexically_relative(from);
  if (result.video) result.video = to->path() / result.video->lexically_relative(from);
  result.folder = to->path();
  result.output = std::move(to);
  return result;
}

std::shared_ptr<io::OutputFolder> taken(const fs::path& folder) {
  auto output = std::make_shared<io::OutputFolder>(folder, files_of_a_run());
  if (!output->replaced().empty()) say(Verbosity::warnings, "%s", output->replaced().c_str());
  return output;
}

SceneResult placed_below(const SweepCases& cases, int number, const fs::path& from,
                         io::OutputFolder& output) {
  const fs::path folder = output.file(cases.folder(number) + "/");
  return placed(cases, number, from, std::make_shared<io::OutputFolder>(folder, files_of_a_run()));
}

SceneResult merged_values(const SweepCases& cases, const cluster::Campaign& campaign) {
  const RunOptions& options = cases.options();
  const auto own = campaign.output(0);
  if (!own)
    throw std::runtime_error("the scene's own run is missing, so there is nothing to merge");
  SceneResult main = placed(cases, 0, *own, taken(options.out));
  say_result(main, options);
  io::OutputFolder& output = *main.output;
  std::vector<SweepRun> runs;
  // As without tasks: where the scene's own run is unstable its sweep says nothing.
  for (int i = 1; i < cases.size() && main.exit_code != exit_unstable; ++i)
    if (const auto from = campaign.output(i)) {
      runs.push_back({cases.scene().sweep->values[i - 1], placed_below(cases, i, *from, output)});
      say_value(cases.scene(), runs.back(), options);
    }
  return end_sweep(cases.scene(), options, std::move(main), runs);
}

SceneResult merged_rows(const SweepCases& cases, const cluster::Campaign& campaign) {
  SceneResult all;
  all.folder = cases.options().out;
  all.output = taken(all.folder);
  std::vector<std::pair<std::size_t, SceneResult>> runs;
  for (int i = 0; i < cases.size(); ++i)
    if (const auto from = campaign.output(i)) {
      runs.emplace_back(i, placed_below(cases, i, *from, *all.output));
      say_row(i, runs.back().second);
    }
  for (const auto& [row, run] : runs)
    if (run.exit_code == exit_unstable) all.exit_code = exit_unstable;
  io::write_file_atomically(all.output->file("sweep.csv"),
                            param_sweep_csv(cases.scene(), *cases.table(), runs));
  return all;
}

}  // namespace

SweepCases::SweepCases(const world::Scene& scene, const std::optional<io::CsvTable>& table,
                       const RunOptions& options)
    : scene_(scene), table_(table), options_(options) {
  if (table) rows_ = scenes_of_rows(scene, *table);
}

int SweepCases::size() const {
  return static_cast<int>(table_ ? rows_.size() : 1 + scene_.sweep->values.size());
}

std::string SweepCases::folder(int number) const {
  if (table_) return folder_of_row(number);
  return number == 0 ? "" : folder_of_value(scene_, scene_.sweep->values[number - 1]);
}

world::Scene SweepCases::scene_of(int number) const {
  if (table_) return rows_[number];
  return number == 0 ? scene_ : scene_of_value(scene_, scene_.sweep->values[number - 1]);
}

RunOptions SweepCases::options_of(int number) const {
  if (table_) return options_of_row(options_);
  return number == 0 ? options_ : options_of_value(options_);
}

int run_case_of(const SweepCases& cases, int number) {
  if (number >= cases.size())
    throw UsageError("--part " + std::to_string(number) + ": the sweep has " +
                     std::to_string(cases.size()) + " cases, expected one from 0 on below that");
  const world::Scene scene = cases.scene_of(number);
  const SceneResult result = run_scene(scene, cases.options_of(number));
  throw_if_stopped();
  write_result(result.output->file(result_file), scene.expectations, result);
  return result.exit_code;
}

SceneResult run_as_tasks(const SweepCases& cases, const CLI::App& verb,
                         const cluster::ClusterOptions& options, const FilesRead& inputs,
                         bool quiet) {
  // Built once: what cannot be built is found before any task, and its files come to the list.
  { const simulation::Simulation simulation(cases.scene_of(0), cases.options().simulation); }
  const CLI::Option* set = verb.get_option("--instruction-set");
  const cluster::Plan plan =
      plan_of(cases, verb, inputs, set->count() > 0 ? set->results().front() : "");
  const auto campaign = run_campaign(cases.options().out, "", plan, options, quiet);
  SceneResult result;
  result.folder = cases.options().out;
  if (!options.no_wait && !stop_requested) {
    result = cases.table() ? merged_rows(cases, *campaign) : merged_values(cases, *campaign);
    if (!campaign->missing_text().empty()) result.exit_code = exit_failure;
  }
  if (stop_requested) result.exit_code = stop_exit_code();
  return result;
}

}  // namespace pedicel::app
