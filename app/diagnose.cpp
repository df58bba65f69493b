#include "app/diagnose.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <thread>

#include "app/headless.h"
#include "discrepancy/diagnosis.h"
#include "discrepancy/report.h"
#include "io/atomic_file.h"
#include "plant/plant_file.h"

namespace pedicel::app {

namespace {

struct DiagnoseArguments {
  std::string experiment, out;
  int threads = 0, seed = 1;
  bool json = false, quiet = false, verbose = false;
};

/// Says on standard error what is being done, how far it is and how long it will take: on a
/// terminal in place, elsewhere a line for each new step.
class ProgressLine {
 public:
  void operator()(const std::string& what, double share) {
    const std::lock_guard lock(mutex_);
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    const bool terminal = isatty(STDERR_FILENO) == 1;
    if (!terminal && what == last_) return;
    char left[48] = "";
    if (share > 0.05)
      std::snprintf(left, sizeof left, ", about %.0f s left", seconds * (1.0 - share) / share);
    std::fprintf(stderr, terminal ? "\r\033[K%3.0f %% %s%s" : "%3.0f %% %s%s\n", 100.0 * share,
                 what.c_str(), left);
    last_ = what;
  }
  void end() {
    if (isatty(STDERR_FILENO) == 1) std::fprintf(stderr, "\r\033[K");
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  Clock::time_point start_ = Clock::now();
  std::string last_;
};

void write_results(const std::filesystem::path& folder, const discrepancy::Experiment& experiment,
                   discrepancy::Diagnosis& diagnosis) {
  using discrepancy::Outcome;
  discrepancy::Verdict& verdict = diagnosis.verdict;
  if (!diagnosis.best.hypothesis.effects.empty() && verdict.outcome != Outcome::bad_data) {
    verdict.extended_plant = "extended.plant.yaml";
    plant::write_plant_file(folder / verdict.extended_plant,
                            discrepancy::extended_plant(experiment, diagnosis.best.hypothesis));
  }
  io::write_file_atomically(folder / "verdict.json", to_json(verdict) + "\n");
  discrepancy::write_report(folder, experiment, diagnosis);
}

int run(const DiagnoseArguments& a) {
  Diagnostics diagnostics;
  const auto experiment = discrepancy::read_experiment(a.experiment, diagnostics);
  if (!experiment) throw InvalidFile(diagnostics);
  ProgressLine progress;
  discrepancy::DiagnosisOptions options;
  options.threads = a.threads > 0
                        ? a.threads
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.seed = static_cast<std::uint64_t>(a.seed);
  options.stop = &stop_requested;
  if (!a.quiet)
    options.progress = [&progress](const std::string& what, double share) {
      progress(what, share);
    };
  if (a.verbose)
    options.note = [](const std::string& sentence) {
      std::fprintf(stderr, "%s\n", sentence.c_str());
    };
  discrepancy::Diagnosis diagnosis = discrepancy::diagnose(*experiment, options);
  progress.end();
  if (stop_requested) return 130;
  const std::filesystem::path folder =
      a.out.empty()
          ? std::filesystem::path("out") / ("diagnosis_" + experiment->folder.filename().string())
          : std::filesystem::path(a.out);
  write_results(folder, *experiment, diagnosis);
  if (a.json)
    std::cout << to_json(diagnosis.verdict) << std::endl;
  else
    std::cout << headline(diagnosis.verdict) << "\nwritten to " << folder.string() << std::endl;
  return exit_code(diagnosis.verdict.outcome);
}

}  // namespace

std::function<int()> add_diagnose_verb(CLI::App& app) {
  const auto a = std::make_shared<DiagnoseArguments>();
  CLI::App* verb = app.add_subcommand(
      "diagnose", "show what the simulation of a measured experiment gets wrong, and why");
  verb->add_option("experiment", a->experiment, "experiment folder (or its experiment.yaml)")
      ->required();
  verb->add_option("--out", a->out, "folder for report.html, verdict.json, extended.plant.yaml");
  verb->add_option("--threads", a->threads, "threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--seed", a->seed, "of the bootstrap")->check(CLI::NonNegativeNumber);
  verb->add_flag("--json", a->json, "the verdict as JSON, and nothing else, on standard output");
  verb->add_flag("--quiet", a->quiet, "no progress");
  verb->add_flag("--verbose", a->verbose, "every finding on standard error as it is made");
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
