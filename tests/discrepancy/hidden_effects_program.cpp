// hidden_effects [--seed S] [--count N] [--first N] [--case N...] [--kind K] [--size X] [--seen]
//                [--threads T] [--out DIR] [--cluster local|slurm ...]
// Makes hidden cases, diagnoses them and scores the verdicts, several cases side by side, one
// thread each, or as tasks of a cluster. Cases whose score stands in DIR/results.jsonl are not done
// again.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <set>
#include <thread>

#include "engine/cluster/campaign.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/thread_pool.h"
#include "engine/io/atomic_file.h"
#include "plugins/cosserat/lanes/instruction_set.h"
#include "tests/discrepancy/case_run.h"
#include "tests/discrepancy/score_report.h"
#include "tests/discrepancy/score_table.h"

namespace {

using namespace pedicel;
using namespace pedicel::hidden;
namespace fs = std::filesystem;

struct Arguments {
  std::uint64_t seed = 1;
  int count = static_cast<int>(case_orders().size()), first = 0, threads = 0;
  std::vector<int> cases;
  double size = 0.0;  // times the smallest identifiable; 0: the list's
  bool seen = false;  // that size counts from where an effect is seen
  std::string kind;   // these alone, where it is not empty
  std::string out = "out/hidden_effects", instruction_set;
  bool keep = false;
  cluster::ClusterOptions cluster;
};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "+") + name;
  return text.empty() ? "-" : text;
}

/// Runs the cases that are still to be done and keeps files and screen up to date.
class Bench {
 public:
  static cluster::ProgramAbout about() {
    return {PEDICEL_VERSION, "", cosserat::checked_instruction_set};
  }

  explicit Bench(const Arguments& a) : a_(a), out_(a.out), results_(out_ / "results.jsonl") {
    scores_ = read_scores(results_, a.seed);
    // Lines of another size may stand in the same file.
    std::erase_if(scores_, [&](const Score& s) {
      return s.times != order(s.number).size || s.told_apart != order(s.number).told_apart;
    });
    std::set<int> done;
    for (const Score& s : scores_) done.insert(s.number);
    std::vector<int> wanted = a.cases;
    if (wanted.empty())
      for (int i = 0; i < a.count; ++i) wanted.push_back(a.first + i);
    const int most = static_cast<int>(case_orders().size());
    for (const int number : wanted)
      if (number >= 0 && number < most && !done.contains(number) &&
          (a.kind.empty() || a.kind == name_of(case_orders()[number].kind)))
        todo_.push_back(number);
  }

  /// `app`: the command line, for tasks.
  int run(const CLI::App& app) {
    fs::create_directories(out_);
    std::printf("%zu cases to do, %zu done before\n", todo_.size(), scores_.size());
    std::fflush(stdout);
    std::string missing;
    if (a_.cluster.wanted())
      missing = as_tasks(app);
    else
      side_by_side();
    if (!fault_.empty()) throw io::WriteError(fault_);
    if (!scores_.empty()) write_score_report(out_, scores_, a_.seed);
    std::printf("%s\n%s\nwritten to %s\n", markdown(score_table(scores_)).c_str(),
                markdown(confusion(scores_)).c_str(), out_.c_str());
    if (!missing.empty()) std::fprintf(stderr, "error: %s\n", missing.c_str());
    if (stop_requested) return stop_exit_code();
    return missing.empty() ? exit_ok : exit_failure;
  }

 private:
  void side_by_side() {
    ThreadPool pool(a_.threads > 0
                        ? a_.threads
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    pool.for_each(static_cast<int>(todo_.size()), [this](int i) {
      if (!stop_requested && fault_.empty()) one(todo_[i]);
    });
  }

  cluster::Plan plan(const CLI::App& app) const {
    cluster::Plan plan;
    plan.verb = "hidden_effects";
    plan.common = cluster::words_of(
        app, {"--out", "--threads", "--case", "--count", "--first", "--kind", "--instruction-set"});
    plan.common.insert(plan.common.end(), {"--threads=1", "--out={out}"});
    plan.again = cluster::words_of_same_call(app);
    plan.instruction_set = a_.instruction_set;
    for (const int number : todo_)
      plan.cases.push_back(
          {"case " + std::to_string(number), {"--case=" + std::to_string(number)}});
    return plan;
  }

  /// What is missing afterwards.
  std::string as_tasks(const CLI::App& app) {
    if (todo_.empty()) return {};
    cluster::Campaign campaign(out_ / "cluster", plan(app), a_.cluster, about());
    const auto say = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
    campaign.run([&](const std::string& what, double) { say(what); }, say);
    // While jobs go on their cases stay to be done, so that another call is about the same ones.
    const bool ended = !a_.cluster.no_wait && !a_.cluster.collect_only && !stop_requested;
    for (std::size_t i = 0; i < todo_.size(); ++i)
      if (const auto from = campaign.output(static_cast<int>(i))) take(*from, ended);
    return ended || a_.cluster.collect_only ? campaign.missing_text() : "";
  }

  /// The score and the notes of a task's case; a case that is left out has none.
  void take(const fs::path& from, bool ended) {
    for (const Score& score : read_scores(from / "results.jsonl", a_.seed)) {
      if (ended) append_score(results_, score);
      scores_.push_back(score);
    }
    std::ranges::sort(scores_, {}, &Score::number);
    std::error_code error;
    if (!fs::exists(from / "notes", error)) return;
    for (const auto& note : fs::directory_iterator(from / "notes"))
      io::write_file_atomically(out_ / "notes" / note.path().filename(),
                                io::read_file(note.path()));
  }

  CaseOrder order(int number) const {
    CaseOrder order = case_orders()[number];
    if (a_.size > 0.0 && order.size > 0.0) order.size = a_.size;
    if (a_.seen) order.told_apart = false;
    return order;
  }

  // Must not throw: it runs in the pool.
  void one(int number) {
    try {
      const CaseRunOptions options{out_ / "cases", 1, &stop_requested};
      const CaseRun run = run_case(a_.seed, order(number), options);
      if (stop_requested) return;
      const std::lock_guard lock(mutex_);
      io::write_file_atomically(out_ / "notes" / (run.hidden.name + ".txt"), run.notes);
      append_score(results_, run.score);
      scores_.push_back(run.score);
      std::ranges::sort(scores_, {}, &Score::number);
      write_score_report(out_, scores_, a_.seed);
      if (!a_.keep) fs::remove_all(run.hidden.folder);
      say(run.score);
    } catch (const NoTrace& error) {
      const std::lock_guard lock(mutex_);
      ++finished_;
      std::printf("case %d is left out: %s\n", number, error.what());
      std::fflush(stdout);
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      fault_ = error.what();
    }
  }

  void say(const Score& s) {
    ++finished_;
    const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
    const double left =
        spent / finished_ * static_cast<double>(static_cast<int>(todo_.size()) - finished_);
    std::printf("case %d %s: hidden %s (%g x), said %s %s: %s; %.0f s, about %.0f min left\n",
                s.number, s.kind.c_str(), joined(s.hidden).c_str(), s.times,
                s.fault.empty() ? s.outcome.c_str() : s.fault.c_str(), joined(s.said).c_str(),
                name_of(s.call), s.seconds, left / 60.0);
    std::fflush(stdout);
  }

  using Clock = std::chrono::steady_clock;
  const Arguments& a_;
  fs::path out_, results_;
  std::vector<Score> scores_;
  std::vector<int> todo_;
  std::mutex mutex_;
  Clock::time_point start_ = Clock::now();
  int finished_ = 0;
  std::string fault_;
};

}  // namespace

int main(int argc, char** argv) {
  if (const auto code = cluster::run_as_task(argc, argv, Bench::about())) return *code;
  CLI::App app{"Diagnoses experiments with a hidden effect and scores the verdicts."};
  Arguments a;
  const int most = static_cast<int>(case_orders().size());
  app.add_option("--seed", a.seed, "what the details of the cases are drawn from")
      ->capture_default_str();
  app.add_option("--count", a.count, "how many cases")->check(CLI::Range(1, most));
  app.add_option("--first", a.first, "number of the first one")->check(CLI::Range(0, most - 1));
  app.add_option("--case", a.cases, "these numbers of `hidden_case --list` only")
      ->check(CLI::Range(0, most - 1));
  app.add_option("--size", a.size,
                 "hide everything at this many times the smallest identifiable size, not at the "
                 "list's own: 100 for what one sees with bare eyes")
      ->check(CLI::PositiveNumber);
  app.add_flag(
      "--seen", a.seen,
      "count sizes from where an effect is seen at all, not from where no other cause does "
      "as well");
  app.add_option("--kind", a.kind, "cases of this kind only")
      ->check(CLI::IsMember({"null", "effect", "pair", "look_alike", "outside"}));
  app.add_option("--threads", a.threads, "cases side by side (default: all cores)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--out", a.out, "folder of the results")->capture_default_str();
  app.add_flag("--keep", a.keep, "keep the experiment folders");
  app.add_option("--instruction-set", a.instruction_set, "that rods are solved with");
  cluster::add_cluster_options(app, a.cluster);
  CLI11_PARSE(app, argc, argv);
  hear_stop_signals();
  stop_in_good_order();
  try {
    a.cluster = cluster::with_profile(a.cluster);
    cosserat::choose_instruction_set(a.instruction_set);
    return Bench(a).run(app);
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_failure;
  }
}
