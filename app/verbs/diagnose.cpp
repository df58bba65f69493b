#include "app/verbs/diagnose.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "app/verbs/experiment_run.h"
#include "app/verbs/part_arguments.h"
#include "app/verbs/scene_experiment.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/data/more_trials.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/report/report.h"
#include "plugins/discrepancy/select/symptom_numbers.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

namespace {

struct DiagnoseArguments : ExperimentArguments {
  std::vector<std::string> with;                                // folders
  std::vector<std::string> settings;                            // NAME=VALUE
  double time_limit = std::numeric_limits<double>::infinity();  // s
  bool verbose = false;
  PartArguments tasks;
};

}  // namespace

void write_diagnosis(const std::filesystem::path& folder, const discrepancy::Experiment& experiment,
                     discrepancy::Diagnosis& diagnosis) {
  using discrepancy::Outcome;
  discrepancy::Verdict& verdict = diagnosis.verdict;
  const bool is_found = verdict.outcome == Outcome::adequate || verdict.outcome == Outcome::named ||
                        verdict.outcome == Outcome::ambiguous;
  if (!diagnosis.best.hypothesis.effects.empty() && is_found) {
    verdict.extended_plant = "extended.plant.yaml";
    plant::write_plant_file(folder / verdict.extended_plant,
                            discrepancy::extended_plant(experiment, diagnosis.best.hypothesis));
  }
  verdict.next = discrepancy::write_next(folder, diagnosis.next);
  io::write_file_atomically(folder / "verdict.json", to_json(verdict) + "\n");
  discrepancy::write_report(folder, experiment, diagnosis);
}

namespace {

// With the trials that were done afterwards.
discrepancy::Experiment load_all(const DiagnoseArguments& a) {
  discrepancy::Experiment experiment = load_experiment(a.experiment);
  for (const std::string& later : a.with)
    discrepancy::add_trials(load_experiment(later), experiment);
  return experiment;
}

/// Where no cause is accepted, what the data show all the same.
std::string what_is_seen(const discrepancy::Verdict& verdict) {
  constexpr std::size_t most = 3;
  const bool accepted = verdict.outcome == discrepancy::Outcome::named ||
                        verdict.outcome == discrepancy::Outcome::adequate;
  return accepted ? "" : symptoms_text(verdict, most);
}

int run(DiagnoseArguments& a, const CLI::App& verb) {
  const SearchParts parts(a.tasks, a, a.folder("diagnosis_"), verb);
  if (!a.tasks.is_task())
    a.check(a.folder("diagnosis_"), {"report.html", "verdict.json", "findings.txt"});
  const discrepancy::Experiment experiment = load_all(a);
  if (experiment.has_robot())
    return diagnose_scene(a, experiment, a.settings, a.time_limit, parts.parts());
  discrepancy::DiagnosisOptions options;
  for (const std::string& one : a.settings) discrepancy::set_setting(options.settings, one);
  options.parts = parts.parts();
  options.seed = static_cast<std::uint64_t>(a.seed);
  options.time_limit = a.time_limit;
  // From now on a signal ends the search, and what is known is written.
  stop_in_good_order();
  bool stopped = false;
  options.cut_short = [&stopped] { stopped = stop_requested.exchange(false); };
  discrepancy::Diagnosis diagnosis = with_progress(a, options, [&](ProgressLine& line) {
    if (a.verbose) options.note = [&line](const std::string& sentence) { line.note(sentence); };
    return discrepancy::diagnose(experiment, options);
  });
  const std::filesystem::path folder = a.folder("diagnosis_", experiment);
  a.write(folder,
          [&](const std::filesystem::path& in) { write_diagnosis(in, experiment, diagnosis); });
  if (a.json)
    std::cout << to_json(diagnosis.verdict) << std::endl;
  else
    std::cout << headline(diagnosis.verdict) << "\n"
              << what_is_seen(diagnosis.verdict) << "written to " << folder.string() << std::endl;
  return stopped ? stop_exit_code() : exit_code(diagnosis.verdict.outcome);
}

}  // namespace

std::function<int()> add_diagnose_verb(CLI::App& app) {
  const auto a = std::make_shared<DiagnoseArguments>();
  CLI::App* verb = app.add_subcommand(
      "diagnose", "show what the simulation of a measured experiment gets wrong, and why");
  add_experiment(*verb, *a);
  add_part_options(*verb, a->tasks);
  add_experiment_options(
      *verb, *a,
      {"folder for report.html, verdict.json, extended.plant.yaml, next/", "of the bootstrap",
       "the verdict as JSON, and nothing else, on standard output"});
  verb->add_option("--with", a->with,
                   "another experiment folder on the same plant, as the answer to next/; "
                   "repeatable")
      ->allow_extra_args(false);
  verb->add_option("--set", a->settings,
                   "NAME=VALUE, repeatable: a setting of `pedicel manual diagnosis_settings`, as "
                   "levels.clear_odds=4; of `pedicel manual scene_settings` where the model is a "
                   "scene")
      ->allow_extra_args(false);
  verb->add_option("--time-limit", a->time_limit,
                   "s after which the search ends, and what is known is written")
      ->check(CLI::Range(1.0e-3, 1.0e9));
  verb->add_flag("--verbose", a->verbose, "every finding on standard error as it is made");
  return [a, verb] { return run(*a, *verb); };
}

}  // namespace pedicel::app
