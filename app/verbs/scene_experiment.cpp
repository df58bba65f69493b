#include "app/verbs/scene_experiment.h"

#include <algorithm>
#include <cstdio>

#include "app/bench/parallel_worlds.h"
#include "app/verbs/lab.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "engine/io/yaml.h"
#include "plugins/discrepancy/data/more_trials.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/report/scene_diagnosis_files.h"
#include "plugins/discrepancy/report/scene_report.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::app {

namespace {

using discrepancy::Experiment;

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

plant::Effect parse_effect(const std::string& text, const Experiment& experiment) {
  Diagnostics diagnostics;
  plant::Effect effect =
      discrepancy::read_scene_effect(io::parse_yaml(text, "--set", diagnostics), experiment);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  return effect;
}

}  // namespace

std::string check_scene_experiment(const Experiment& experiment, Diagnostics& diagnostics) {
  // Builds the plants and smooths the readings, and simulates nothing.
  try {
    const discrepancy::SceneSimulator simulator(experiment, {}, 1);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return {};
  }
  const discrepancy::SceneDataSet data(experiment);
  int samples = 0;
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t)
    samples += data.samples(t, std::numeric_limits<double>::infinity());
  return "a robot at " + counted(experiment.plants.size(), "plant") + ": " +
         counted(experiment.trials.size(), "trial") + ", " +
         counted(experiment.markers.size(), "marker") + ", " +
         counted(experiment.cameras.size(), "camera") + ", " +
         counted(experiment.wrenches.size(), "wrench sensor") + ", " + std::to_string(samples) +
         " numbers measured";
}

Experiment observed_scene(const ObserveArguments& a, const Experiment& like) {
  if (!a.plant.empty())
    throw UsageError("--plant: " + a.like + " has a whole scene, expected no single plant of it");
  discrepancy::SceneVariant variant;
  for (const std::string& text : a.set) variant.effects.push_back(parse_effect(text, like));
  discrepancy::SceneObserveOptions options;
  options.numerics.distance = a.distance;
  options.numerics.dt = a.dt;
  options.seed = a.seed;
  options.threads = a.threads;
  try {
    return discrepancy::observed_scene(like, variant, options);
  } catch (const discrepancy::SceneFailed& fault) {
    throw UnstableWorld(fault.what());
  }
}

namespace {

void check_fitted(const ExperimentArguments& a, const Experiment& experiment) {
  if (std::ranges::all_of(experiment.trials, [](const discrepancy::Trial& trial) {
        return trial.use == discrepancy::Trial::Use::check;
      }))
    throw UsageError(a.experiment + ": every trial has use: check, expected one to be fitted");
}

}  // namespace

int diagnose_scene(const ExperimentArguments& a, const Experiment& experiment,
                   const std::vector<std::string>& settings, double time_limit,
                   discrepancy::FitParts* parts) {
  discrepancy::SceneDiagnosisOptions options;
  for (const std::string& one : settings) discrepancy::set_setting(options.settings, one);
  check_fitted(a, experiment);
  const std::filesystem::path folder = a.folder("diagnosis_");
  options.parts = parts;
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
    discrepancy::write_scene_diagnosis(in, experiment, diagnosis);
  });
  if (a.json)
    std::printf("%s\n", to_json(diagnosis.verdict).c_str());
  else
    std::printf("%swritten to %s\n", discrepancy::scene_card_text(diagnosis).c_str(),
                folder.string().c_str());
  return stopped ? stop_exit_code() : exit_code(diagnosis.verdict.outcome);
}

namespace {

/// Rounds of diagnosis and next motion.
class SceneLab {
 public:
  SceneLab(const ExperimentArguments& a, const std::string& truth,
           const std::vector<std::string>& set, Experiment experiment)
      : a_(a), truth_(scene_of(truth)), set_(set), experiment_(std::move(experiment)) {
    check_fitted(a, experiment_);
  }

  /// Into a folder that is being written.
  void play(const std::filesystem::path& in, int rounds) {
    for (int round = 0; round <= rounds; ++round) {
      discrepancy::SceneDiagnosis found = diagnosis();
      if (stopped_) break;  // the rounds before stay
      const std::string name = "round_" + std::to_string(round);
      std::filesystem::create_directories(in / name);
      discrepancy::write_scene_diagnosis(in / name, experiment_, found);
      last_ = found.verdict;
      told_.push_back(lab_round(round, experiment_.trials.size(), last_));
      if (!a_.json) std::printf("%s: %s\n", name.c_str(), headline(last_).c_str());
      std::fflush(stdout);
      if (last_.next.empty() || round == rounds) break;
      answer(in / name / "next", found.next, round);
    }
    io::write_file_atomically(in / "lab.json", told_.dump(2) + "\n");
  }

  bool stopped() const { return stopped_; }
  const discrepancy::Verdict& last() const { return last_; }
  std::string told() const { return told_.dump(2); }

 private:
  discrepancy::SceneDiagnosis diagnosis() {
    discrepancy::SceneDiagnosisOptions options;
    options.threads = a_.thread_count();
    options.stop = &stop_requested;
    ProgressLine progress;
    options.progress = progress.callback(a_.quiet);
    discrepancy::SceneDiagnosis found = discrepancy::diagnose_scene(experiment_, options);
    stopped_ = stop_requested;
    progress.end(stopped_);
    return found;
  }

  // The motion that was asked for, on the truth, with the noise that the instruments have shown;
  // what was measured takes the place of the plan's empty tables.
  void answer(const std::filesystem::path& plan, const discrepancy::SceneNext& next, int round) {
    Experiment like = load_experiment(plan, truth_);
    like.noise = next.noise;
    ObserveArguments observe;
    observe.set = set_;
    observe.seed =
        static_cast<std::uint64_t>(a_.seed) + 1000u * static_cast<std::uint64_t>(round + 1);
    observe.threads = a_.thread_count();
    Experiment measured = *next.experiment;  // what was measured does not say what the truth is
    measured.trials = observed_scene(observe, like).trials;
    measured.folder = plan;
    discrepancy::write_experiment(plan, measured);
    discrepancy::add_trials(measured, experiment_);
  }

  const ExperimentArguments& a_;
  std::filesystem::path truth_;  // a scene
  const std::vector<std::string>& set_;
  Experiment experiment_;
  nlohmann::ordered_json told_ = nlohmann::ordered_json::array();
  discrepancy::Verdict last_;
  bool stopped_ = false;
};

}  // namespace

int lab_scene(const ExperimentArguments& a, Experiment experiment, const std::string& truth,
              const std::vector<std::string>& set, int rounds) {
  SceneLab lab(a, truth, set, std::move(experiment));
  const std::filesystem::path folder = a.folder("lab_");
  a.write(folder, [&](const std::filesystem::path& in) { lab.play(in, rounds); });
  if (lab.stopped()) return stop_exit_code();
  if (a.json)
    std::printf("%s\n", lab.told().c_str());
  else
    std::printf("written to %s\n", folder.string().c_str());
  return exit_code(lab.last().outcome);
}

}  // namespace pedicel::app
