#include "app/verbs/cluster.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <iterator>
#include <optional>

#include "app/report/version.h"
#include "engine/cluster/slurm_queue.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/timer.h"
#include "engine/core/verbosity.h"
#include "engine/io/atomic_file.h"
#include "plugins/cosserat/lanes/instruction_set.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;

/// Off a terminal each line stays: one now and then is enough.
constexpr double seconds_between_lines = 30.0;

cluster::Progress shown_by(ProgressLine& line, bool quiet) {
  if (quiet || verbosity() < Verbosity::lines) return {};
  const bool on_terminal = ::isatty(STDERR_FILENO) == 1;
  return [on_terminal, show = line.callback(false), last = std::optional<Timer>()](
             const std::string& what, double share) mutable {
    if (!on_terminal && last && last->seconds() < seconds_between_lines) return;
    last.emplace();
    show(what, share);
  };
}

}  // namespace

cluster::ProgramAbout program_about() {
  return {version(), git_hash(), cosserat::checked_instruction_set};
}

void add_instruction_set_option(CLI::App& verb) {
  verb.add_option_function<std::string>(
      "--instruction-set",
      [](const std::string& name) {
        try {
          cosserat::choose_instruction_set(name);
        } catch (const UsageError& fault) {
          throw CLI::ValidationError("--instruction-set", fault.what());
        }
      },
      "that rods are solved with, such as AVX2 (default: the best of the processor)");
}

std::unique_ptr<cluster::Campaign> run_campaign(const fs::path& out, const std::string& stage,
                                                const cluster::Plan& plan,
                                                const cluster::ClusterOptions& options,
                                                bool quiet) {
  stop_in_good_order();
  fs::path folder = out / "cluster";
  if (!stage.empty()) folder /= stage;
  auto campaign = std::make_unique<cluster::Campaign>(folder, plan, options, program_about());
  ProgressLine line;
  campaign->run(shown_by(line, quiet), [&line](const std::string& text) { line.note(text); });
  line.end(false);
  if (!options.no_wait && !stop_requested && !campaign->missing_text().empty())
    say(Verbosity::errors, "error: %s\n`pedicel cluster resume %s` does what is missing",
        campaign->missing_text().c_str(), out.c_str());
  return campaign;
}

void place_files(const fs::path& from, io::OutputFolder& to, const std::string& left_out) {
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    const std::string name = entry.path().lexically_relative(from).generic_string();
    if (entry.is_directory() || name == left_out || name.starts_with(".pedicel-files")) continue;
    io::link_or_copy(entry.path(), to.file(name));
  }
}

namespace {

struct ClusterArguments {
  std::string action, folder, scratch;
  int block = -1;
};

bool has_tasks(const fs::path& folder) {
  std::error_code error;
  return fs::exists(cluster::RunFolder(folder).tasks(), error);
}

/// A run's folder, that of its verb, or that of its stages.
std::vector<fs::path> runs_in(const fs::path& folder) {
  for (const fs::path& one : {folder, folder / "cluster"})
    if (has_tasks(one)) return {one};
  std::vector<fs::path> stages;
  std::error_code error;
  for (const fs::path& place : {folder, folder / "cluster"})
    for (fs::directory_iterator entry(place, error), end; !error && entry != end;
         entry.increment(error))
      if (has_tasks(entry->path())) stages.push_back(entry->path());
  std::ranges::sort(stages);
  if (stages.empty())
    throw UsageError(folder.string() +
                     ": has no tasks.jsonl, expected the folder of a run with --cluster");
  return stages;
}

std::string counted_cases(const cluster::Survey& survey, const cluster::TaskHead& head) {
  return head.verb + ", " + std::to_string(survey.done()) + " of " + std::to_string(head.cases) +
         " cases are done, in " + std::to_string(head.blocks) + " blocks of " +
         (head.case_seconds > 0.0
              ? "about " +
                    std::to_string(static_cast<int>(head.case_seconds * head.cases / head.blocks)) +
                    " s"
              : std::string("unknown length"));
}

/// From what the cases took that are done; empty: nothing is known, or nothing runs.
std::string time_left(const cluster::Survey& survey, const cluster::Queue::State& state) {
  if (survey.done() == 0 || state.running == 0 || survey.missing.empty()) return {};
  const double each = survey.seconds / survey.done();
  const double left = each * static_cast<double>(survey.missing.size()) / state.running;
  return ", about " + std::to_string(std::lround(left)) + " s left";
}

int tell(const fs::path& folder) {
  const cluster::RunFolder run(folder);
  const cluster::TaskFile tasks = cluster::read_task_file(run.tasks());
  const cluster::Survey survey = cluster::Surveyor(run, tasks).look(true);
  std::cout << folder.string() << ": " << counted_cases(survey, tasks.head) << "\n";
  if (!cluster::read_jobs(run).jobs.empty()) {
    cluster::SlurmQueue queue(run, tasks.head, {});
    const cluster::Queue::State state = queue.state();
    std::cout << "  " << queue.left() << ": "
              << (state.known
                      ? std::to_string(state.running) + " tasks running, " +
                            std::to_string(state.waiting) + " waiting" + time_left(survey, state)
                      : std::string("Slurm does not answer"))
              << "\n";
  }
  for (const cluster::CaseRecord& failure : survey.failures)
    std::cout << "  " << failure.name << " failed on " << failure.host << ": " << failure.reason
              << "\n";
  if (const std::string fault = mixture(survey); !fault.empty()) std::cout << "  " << fault << "\n";
  std::cout << std::flush;
  return exit_ok;
}

int cancel(const fs::path& folder) {
  const cluster::RunFolder run(folder);
  if (cluster::read_jobs(run).jobs.empty()) {
    std::cout << folder.string()
              << ": has no job of Slurm; tasks of this machine end with Ctrl-C where they were "
                 "started"
              << std::endl;
    return exit_ok;
  }
  cluster::SlurmQueue queue(run, cluster::read_task_head(run.tasks()), {});
  queue.cancel();
  std::cout << folder.string() << ": " << queue.left() << " is cancelled" << std::endl;
  return exit_ok;
}

/// The verb's own folder (--out), of the folder of its run or of a stage. It is where the run lies
/// now, which another folder may be a copy of. Throws UsageError for a run that lies elsewhere.
fs::path out_of(const fs::path& run) {
  fs::path folder = fs::absolute(run).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  if (folder.filename() != "cluster") folder = folder.parent_path();
  if (folder.filename() != "cluster")
    throw UsageError(
        run.string() +
        ": lies in no folder of the name cluster, expected it where --cluster made it");
  return folder.parent_path();
}

/// The call that wrote the task file, once more: it finds what is done. Results come into the
/// folder where the run lies now.
int call_again(const fs::path& folder, bool collect_only) {
  const cluster::TaskHead head = cluster::read_task_head(cluster::RunFolder(folder).tasks());
  std::vector<std::string> words{head.file.string()};
  const fs::path out = out_of(folder);
  std::ranges::copy_if(head.again, std::back_inserter(words),
                       [](const std::string& word) { return !word.starts_with("--out="); });
  words.push_back("--out=" + out.string());
  if (collect_only) words.emplace_back("--collect-only");
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::error_code error;
  fs::current_path(head.folder, error);
  if (error) throw UsageError(head.folder.string() + ": " + error.message());
  ::execv(argv[0], argv.data());
  throw std::runtime_error(words.front() + ": cannot be started: " + std::strerror(errno));
}

int run(const ClusterArguments& a) {
  if ((a.action == "task") != (a.block >= 0))
    throw UsageError("cluster " + a.action + ": expected a block with `task`, and with it only");
  if (a.action == "task")
    return cluster::run_task(fs::absolute(a.folder), a.block, a.scratch, program_about());
  const std::vector<fs::path> runs = runs_in(a.folder);
  if (a.action == "resume" || a.action == "collect")
    return call_again(runs.front(), a.action == "collect");
  int code = exit_ok;
  for (const fs::path& one : runs)
    code = std::max(code, a.action == "cancel" ? cancel(one) : tell(one));
  return code;
}

}  // namespace

std::function<int()> add_cluster_verb(CLI::App& app) {
  const auto a = std::make_shared<ClusterArguments>();
  CLI::App* verb = app.add_subcommand(
      "cluster", "look at a run with --cluster, take it up again, merge it, cancel it");
  verb->add_option("action", a->action, "what to do; task: one block, which tasks do themselves")
      ->required()
      ->check(CLI::IsMember({"status", "resume", "collect", "cancel", "task"}));
  verb->add_option("folder", a->folder, "the run's folder (--out)")->required();
  verb->add_option("block", a->block, "of a task")->check(CLI::NonNegativeNumber);
  verb->add_option("--scratch", a->scratch, "folder where a task makes results first");
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
