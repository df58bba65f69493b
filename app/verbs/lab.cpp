#include "app/verbs/lab.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/verbs/diagnose.h"
#include "app/verbs/experiment_run.h"
#include "app/verbs/observe.h"
#include "app/verbs/scene_experiment.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/data/more_trials.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/report/report.h"

namespace pedicel::app {

namespace {

struct LabArguments : ExperimentArguments {
  std::string truth;
  std::vector<std::string> set;  // effects of the truth that its file does not have
  int rounds = 2;
};

// The trial that was asked for, on the truth, with the noise that the instruments have shown.
discrepancy::Experiment answered(const LabArguments& a, const discrepancy::Diagnosis& diagnosis,
                                 int round) {
  ObserveArguments observe;
  observe.model = a.truth;
  observe.set = a.set;
  observe.seed = static_cast<std::uint64_t>(a.seed) + 1000u * static_cast<std::uint64_t>(round + 1);
  observe.noise_position = diagnosis.position_noise.std;
  observe.noise_force = diagnosis.force_noise.std;
  observe.threads = a.thread_count();
  return observed(observe, *diagnosis.next.experiment);
}

int run(const LabArguments& a) {
  discrepancy::Experiment experiment = load_experiment(a.experiment);
  if (experiment.has_robot()) return lab_scene(a, std::move(experiment), a.truth, a.set, a.rounds);
  const plant::PlantFile nominal = experiment.plant();
  const std::filesystem::path folder = a.folder("lab_", experiment);
  nlohmann::ordered_json told = nlohmann::ordered_json::array();
  discrepancy::Verdict last;
  bool stopped = false;
  const auto play = [&](const std::filesystem::path& in) {
    for (int round = 0; round <= a.rounds; ++round) {
      discrepancy::DiagnosisOptions options;
      options.seed = static_cast<std::uint64_t>(a.seed);
      discrepancy::Diagnosis found = with_progress(
          a, options, [&](ProgressLine&) { return discrepancy::diagnose(experiment, options); });
      stopped = found.stopped;
      if (stopped) break;  // the rounds before stay
      const std::string name = "round_" + std::to_string(round);
      std::filesystem::create_directories(in / name);
      write_diagnosis(in / name, experiment, found);
      last = found.verdict;
      told.push_back(lab_round(round, experiment.trials.size(), last));
      if (!a.json) std::cout << name << ": " << headline(last) << std::endl;
      if (!found.next.experiment || round == a.rounds) break;
      discrepancy::Experiment answer = answered(a, found, round);
      answer.plant() = nominal;  // what was measured does not say what the plant is
      answer.folder = in / name / "next";
      discrepancy::write_experiment(answer.folder, answer);
      discrepancy::add_trials(answer, experiment);
    }
    io::write_file_atomically(in / "lab.json", told.dump(2) + "\n");
  };
  a.write(folder, play);
  if (stopped) return stop_exit_code();
  if (a.json)
    std::cout << told.dump(2) << std::endl;
  else
    std::cout << "written to " << folder.string() << std::endl;
  return exit_code(last.outcome);
}

}  // namespace

nlohmann::ordered_json lab_round(int round, std::size_t trials,
                                 const discrepancy::Verdict& verdict) {
  nlohmann::ordered_json causes = nlohmann::ordered_json::array();
  for (const discrepancy::NamedCause& cause : verdict.causes) causes.push_back(cause.name);
  return {{"round", round},
          {"trials", trials},
          {"verdict", to_string(verdict.outcome)},
          {"causes", causes},
          {"next", verdict.next_experiment}};
}

std::function<int()> add_lab_verb(CLI::App& app) {
  const auto a = std::make_shared<LabArguments>();
  CLI::App* verb = app.add_subcommand(
      "lab", "play diagnosis and next experiment against a hidden truth, round after round");
  verb->add_option("truth", a->truth,
                   "plant file, scene or experiment of what is really there, with its effects")
      ->required();
  add_experiment(*verb, *a);
  verb->add_option("--rounds", a->rounds, "experiments to do at most")->check(CLI::Range(0, 100));
  verb->add_option("--truth-set", a->set,
                   "an effect of the truth as in a file, \"{name: ..., ...}\"; may be repeated")
      ->allow_extra_args(false);
  add_experiment_options(*verb, *a,
                         {"folder for lab.json and one folder a round", "of noise and bootstrap",
                          "lab.json, and nothing else, on standard output"});
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
