#include "app/verbs/experiment_run.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/verbs/cluster.h"
#include "app/verbs/run_arguments.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/output_check.h"
#include "engine/io/output_folder.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"

namespace pedicel::app {

namespace {

bool on_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

}  // namespace

int ExperimentArguments::thread_count() const {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::filesystem::path ExperimentArguments::folder(const std::string& prefix,
                                                  const discrepancy::Experiment& measured) const {
  if (!out.empty()) return out;
  return std::filesystem::path("out") / (prefix + measured.folder.filename().string());
}

std::filesystem::path ExperimentArguments::folder(const std::string& prefix) const {
  if (!out.empty()) return out;
  std::filesystem::path measured = std::filesystem::absolute(experiment).lexically_normal();
  if (!measured.has_filename() || measured.extension() == ".yaml")
    measured = measured.parent_path();
  return std::filesystem::path("out") / (prefix + measured.filename().string());
}

void ExperimentArguments::check(const std::filesystem::path& folder,
                                const std::vector<std::string>& files) const {
  io::check_output_folder(folder, files);
}

void ExperimentArguments::write(
    const std::filesystem::path& folder,
    const std::function<void(const std::filesystem::path&)>& write) const {
  stop_in_good_order();
  const std::string replaced = io::write_folder(folder, write);
  if (!replaced.empty()) std::fprintf(stderr, "%s\n", replaced.c_str());
}

void add_experiment(CLI::App& verb, ExperimentArguments& a) {
  finds_shipped(
      verb.add_option("experiment", a.experiment, "experiment folder (or its experiment.yaml)"))
      ->required();
}

void add_experiment_options(CLI::App& verb, ExperimentArguments& a, const ExperimentHelp& help) {
  verb.add_option("--out", a.out, help.out);
  verb.add_option("--threads", a.threads, "threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  verb.add_option("--seed", a.seed, help.seed)->check(CLI::NonNegativeNumber);
  verb.add_flag("--json", a.json, help.json);
  verb.add_flag("--quiet", a.quiet, "no progress");
  add_instruction_set_option(verb);
}

discrepancy::Experiment load_experiment(const std::filesystem::path& path,
                                        const std::filesystem::path& scene) {
  Diagnostics diagnostics;
  auto experiment = discrepancy::read_experiment(path, diagnostics, {.scene = scene});
  if (!experiment) throw InvalidFile(diagnostics);
  return *std::move(experiment);
}

ProgressLine::Callback ProgressLine::callback(bool quiet) {
  if (quiet) return {};
  return [this](const std::string& what, double share) { show(what, share); };
}

void ProgressLine::show(const std::string& what, double share) {
  const std::lock_guard lock(mutex_);
  if (!on_terminal() && what == last_) return;
  clear();
  if (!first_share_) first_share_ = share, start_ = Clock::now();
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = share - *first_share_;
  std::fprintf(stderr, "%3.0f %% %s", 100.0 * share, what.c_str());
  if (done > 0.05 * (1.0 - *first_share_))
    std::fprintf(stderr, ", about %.0f s left", seconds * (1.0 - share) / done);
  if (!on_terminal()) std::fprintf(stderr, "\n");
  last_ = what;
}

void ProgressLine::note(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  clear();
  std::fprintf(stderr, "%s\n", sentence.c_str());
}

void ProgressLine::end(bool stopped) {
  const std::lock_guard lock(mutex_);
  clear();
  if (stopped) std::fprintf(stderr, "stopped; nothing was written\n");
}

void ProgressLine::clear() {
  if (on_terminal()) std::fprintf(stderr, "\r\033[K");
}

}  // namespace pedicel::app
