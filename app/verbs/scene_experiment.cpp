#include "pedicel/app/verbs/scene_experiment.h"

#include <chrono>
#include <cstdio>

#include "pedicel/app/verbs/parallel_worlds.h"
#include "pedicel/core/check.h"
#include "pedicel/core/stop.h"
#include "pedicel/discrepancy/scene/scene_data.h"
#include "pedicel/discrepancy/scene/scene_effects.h"
#include "pedicel/discrepancy/scene/scene_observe.h"
#include "pedicel/discrepancy/scene_procedure/scene_verdict.h"
#include "pedicel/io/atomic_file.h"
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

// The predictions of contact that sticks at the edge of slipping are not yet so good that what is
// left of the data could be judged: the fits are told, and no cause is named.
void withhold(discrepancy::Verdict& verdict) {
  verdict.outcome = discrepancy::Outcome::numerical;
  verdict.nearest.insert(verdict.nearest.begin(), verdict.causes.begin(), verdict.causes.end());
  verdict.causes.clear();
  verdict.next_experiment.clear();
  verdict.remainder =
      "experiments of scenes are simulated and fitted, but not judged yet: findings.txt has what "
      "is left with each candidate cause";
}

constexpr const char* no_verdict =
    "No verdict: experiments of scenes are simulated and fitted, but not judged yet. What is left "
    "with each candidate cause:";

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

int diagnose_scene_verb(const ExperimentArguments& a) {
  const SceneExperiment experiment = read_whole(a.experiment, {});
  const discrepancy::SceneDataSet data(experiment);
  discrepancy::SceneSimulator simulator(experiment, {}, a.thread_count(), &stop_requested);
  discrepancy::SceneEvaluator evaluator(simulator, data);
  discrepancy::SceneSearchOptions options;
  options.stop = &stop_requested;
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t)
    if (experiment.trials[static_cast<std::size_t>(t)].use != discrepancy::Trial::Use::check)
      options.trials.push_back(t);
  if (options.trials.empty())
    throw UsageError(a.experiment + ": every trial has use: check, expected one to be fitted");
  ProgressLine progress;
  options.progress = progress.callback(a.quiet);
  const auto start = std::chrono::steady_clock::now();
  const discrepancy::SceneFindings findings = discrepancy::search_scene(evaluator, options);
  progress.end(findings.partial);
  throw_if_stopped();
  const discrepancy::Verdict verdict = [&] {
    discrepancy::Verdict told = discrepancy::verdict_of(findings, experiment);
    withhold(told);
    told.simulations = simulator.simulations();
    told.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return told;
  }();
  const std::filesystem::path folder =
      a.out.empty()
          ? std::filesystem::path("out") /
                ("diagnosis_" + std::filesystem::absolute(experiment.folder).filename().string())
          : std::filesystem::path(a.out);
  const std::string text = discrepancy::findings_text(findings, experiment);
  a.write(folder, [&](const std::filesystem::path& in) {
    io::write_file_atomically(in / "findings.txt", std::string(no_verdict) + "\n" + text);
    io::write_file_atomically(in / "verdict.json", to_json(verdict) + "\n");
  });
  if (a.json)
    std::printf("%s\n", to_json(verdict).c_str());
  else
    std::printf("%s\n%swritten to %s\n", no_verdict, text.c_str(), folder.string().c_str());
  return exit_code(verdict.outcome);
}

}  // namespace pedicel::app
