#include "pedicel/app/verbs/scene_experiment.h"

#include <algorithm>
#include <cstdio>

#include "pedicel/app/bench/parallel_worlds.h"
#include "pedicel/core/check.h"
#include "pedicel/core/stop.h"
#include "pedicel/discrepancy/report/scene_report.h"
#include "pedicel/discrepancy/scene/scene_data.h"
#include "pedicel/discrepancy/scene/scene_effects.h"
#include "pedicel/discrepancy/scene/scene_observe.h"
#include "pedicel/discrepancy/scene_procedure/extended_scene.h"
#include "pedicel/discrepancy/scene_procedure/scene_diagnosis.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/output_check.h"
#include "pedicel/io/output_folder.h"
#include "pedicel/io/yaml.h"

namespace pedicel::app {

namespace {

using discrepancy::SceneExperiment;

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

SceneExperiment read_whole(const std::filesystem::path& path, const std::filesystem::path& scene) {
  Diagnostics diagnostics;
  auto experiment = discrepancy::read_scene_experiment(path, diagnostics, scene);
  if (!experiment) throw InvalidFile(diagnostics);
  return std::move(*experiment);
}

plant::Effect parse_effect(const std::string& text, const SceneExperiment& experiment) {
  Diagnostics diagnostics;
  plant::Effect effect =
      discrepancy::read_scene_effect(io::parse_yaml(text, "--set", diagnostics), experiment);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  return effect;
}

// The scene to simulate; empty: the experiment's own.
std::filesystem::path scene_of(const std::filesystem::path& model) {
  if (discrepancy::is_scene_experiment(model)) {
    const SceneExperiment other = read_whole(model, {});
    return other.scene.file;
  }
  return model;
}

}  // namespace

std::string check_scene_experiment(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const auto experiment = discrepancy::read_scene_experiment(path, diagnostics);
  if (!experiment) return {};
  // Builds the plants and smooths the readings, and simulates nothing.
  try {
    const discrepancy::SceneSimulator simulator(*experiment, {}, 1);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return {};
  }
  const discrepancy::SceneDataSet data(*experiment);
  int samples = 0;
  for (int t = 0; t < static_cast<int>(experiment->trials.size()); ++t)
    samples += data.samples(t, std::numeric_limits<double>::infinity());
  return "a robot at " + counted(experiment->plants.size(), "plant") + ": " +
         counted(experiment->trials.size(), "trial") + ", " +
         counted(experiment->markers.size(), "marker") + ", " +
         counted(experiment->cameras.size(), "camera") + ", " +
         counted(experiment->wrenches.size(), "wrench sensor") + ", " + std::to_string(samples) +
         " numbers measured";
}

int observe_scene_verb(const ObserveArguments& a) {
  if (!a.plant.empty())
    throw UsageError("--plant: " + a.like + " has a whole scene, expected no single plant of it");
  const SceneExperiment like = read_whole(a.like, scene_of(a.model));
  io::check_output_folder(a.out, {"experiment.yaml"});
  discrepancy::SceneVariant variant;
  for (const std::string& text : a.set) variant.effects.push_back(parse_effect(text, like));
  discrepancy::SceneObserveOptions options;
  options.numerics.distance = a.distance;
  options.numerics.dt = a.dt;
  options.seed = a.seed;
  options.threads = a.threads;
  SceneExperiment made;
  try {
    made = discrepancy::observed_scene(like, variant, options);
  } catch (const discrepancy::SceneFailed& fault) {
    throw UnstableWorld(fault.what());
  }
  stop_in_good_order();
  const std::string replaced = io::write_folder(a.out, [&](const std::filesystem::path& in) {
    discrepancy::write_scene_experiment(in, made);
  });
  if (!replaced.empty()) std::fprintf(stderr, "%s\n", replaced.c_str());
  std::fprintf(stderr, "written to %s\n", a.out.c_str());
  return 0;
}

namespace {

void write_scene_diagnosis(const std::filesystem::path& folder, const SceneExperiment& experiment,
                           discrepancy::SceneDiagnosis& diagnosis) {
  using discrepancy::Outcome;
  discrepancy::Verdict& verdict = diagnosis.verdict;
  const bool is_found = verdict.outcome == Outcome::adequate || verdict.outcome == Outcome::named ||
                        verdict.outcome == Outcome::ambiguous;
  if (is_found && !diagnosis.model.empty()) {
    const int trial = diagnosis.fit_trials.empty() ? -1 : diagnosis.fit_trials.front();
    const discrepancy::ExtendedScene extended =
        discrepancy::write_extended_scene(folder, experiment, diagnosis.model, trial);
    verdict.extended_scene = extended.file;
    if (std::filesystem::exists(folder / "extended.plant.yaml"))
      verdict.extended_plant = "extended.plant.yaml";
    for (const std::string& left : extended.left)
      diagnosis.text += "  extended.scene.yaml is without " + left + "\n";
  }
  io::write_file_atomically(folder / "findings.txt", diagnosis.text);
  io::write_file_atomically(folder / "verdict.json", to_json(verdict) + "\n");
  discrepancy::write_scene_report(folder, experiment, diagnosis);
}

}  // namespace

int diagnose_scene_verb(const ExperimentArguments& a, const std::vector<std::string>& settings,
                        double time_limit) {
  discrepancy::SceneDiagnosisOptions options;
  for (const std::string& one : settings) discrepancy::set_setting(options.settings, one);
  const SceneExperiment experiment = read_whole(a.experiment, {});
  if (std::ranges::all_of(experiment.trials, [](const discrepancy::SceneTrial& trial) {
        return trial.use == discrepancy::Trial::Use::check;
      }))
    throw UsageError(a.experiment + ": every trial has use: check, expected one to be fitted");
  const std::filesystem::path folder =
      a.out.empty()
          ? std::filesystem::path("out") /
                ("diagnosis_" + std::filesystem::absolute(experiment.folder).filename().string())
          : std::filesystem::path(a.out);
  a.check(folder, {"report.html", "verdict.json", "findings.txt"});
  options.threads = a.thread_count();
  options.time_limit = time_limit;
  options.stop = &stop_requested;
  // From now on a signal ends the search, and what is known is written.
  stop_in_good_order();
  bool stopped = false;
  options.cut_short = [&stopped] { stopped = stop_requested.exchange(false); };
  ProgressLine progress;
  options.progress = progress.callback(a.quiet);
  discrepancy::SceneDiagnosis diagnosis = discrepancy::diagnose_scene(experiment, options);
  progress.end(stop_requested);
  throw_if_stopped();
  a.write(folder, [&](const std::filesystem::path& in) {
    write_scene_diagnosis(in, experiment, diagnosis);
  });
  if (a.json)
    std::printf("%s\n", to_json(diagnosis.verdict).c_str());
  else
    std::printf("%swritten to %s\n", discrepancy::scene_card_text(diagnosis).c_str(),
                folder.string().c_str());
  return stopped ? stop_exit_code() : exit_code(diagnosis.verdict.outcome);
}

}  // namespace pedicel::app
