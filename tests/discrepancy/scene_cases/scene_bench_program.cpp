// scene_bench [--seed S] [--first N] [--count N] [--case N...] [--kind K] [--threads T] [--out DIR]
// Makes cases, diagnoses them and scores the verdicts, several side by side, one thread each.
// Cases whose line stands in DIR/results.jsonl are not done again.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>

#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/thread_pool.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/discrepancy/scene_cases/scored_case.h"

namespace {

using namespace pedicel;
using namespace pedicel::scene_case;
namespace fs = std::filesystem;

struct Arguments {
  std::uint64_t seed = 1;
  int first = 0, count = static_cast<int>(orders().size()), threads = 1;
  std::vector<int> cases;
  std::string kind, out = "out/scene_bench";
  bool keep = false;
};

class Bench {
 public:
  explicit Bench(const Arguments& a) : a_(a), out_(a.out), results_(out_ / "results.jsonl") {
    read();
    std::vector<int> wanted = a.cases;
    if (wanted.empty())
      for (int i = 0; i < a.count; ++i) wanted.push_back(a.first + i);
    const std::vector<Order> all = orders();
    for (const int number : wanted) {
      if (number < 0 || number >= static_cast<int>(all.size()) || scores_.contains(number))
        continue;
      const Order& order = all[static_cast<std::size_t>(number)];
      if (a.kind.empty() || a.kind == order.kind) todo_.push_back(order);
    }
  }

  int run() {
    fs::create_directories(out_);
    std::printf("%zu cases to do, %zu done before\n", todo_.size(), scores_.size());
    std::fflush(stdout);
    ThreadPool pool(a_.threads);
    pool.for_each(static_cast<int>(todo_.size()), [this](int i) {
      if (!stop_requested && fault_.empty()) one(todo_[static_cast<std::size_t>(i)]);
    });
    if (!fault_.empty()) throw io::WriteError(fault_);
    write_tables();
    std::printf("%s\n%s\nwritten to %s\n", rates_text(list()).c_str(),
                confusion_text(list()).c_str(), out_.c_str());
    return stop_requested ? stop_exit_code() : exit_ok;
  }

 private:
  void read() {
    std::ifstream in(results_);
    for (std::string line; std::getline(in, line);) try {
        const SceneScore score = from_line(line);
        if (score.seed == a_.seed) scores_[score.number] = score;
      } catch (const std::exception&) {  // half a line, of a run that was ended
      }
  }

  std::vector<SceneScore> list() const {
    std::vector<SceneScore> all;
    for (const auto& [number, score] : scores_) all.push_back(score);
    return all;
  }

  // Must not throw: it runs in the pool.
  void one(const Order& order) {
    try {
      char name[32];
      std::snprintf(name, sizeof name, "case_%03d", order.number);
      std::string notes;
      const SceneScore score =
          run_case(order, a_.seed, out_ / "cases" / name, 1, notes, &stop_requested);
      if (stop_requested) return;
      const std::lock_guard lock(mutex_);
      io::write_file_atomically(out_ / "notes" / (std::string(name) + ".txt"), notes);
      append(to_line(score));
      scores_[order.number] = score;
      write_tables();
      if (!a_.keep) fs::remove_all(out_ / "cases" / name);
      std::printf("%s\n", to_line(score).c_str());
      std::fflush(stdout);
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      fault_ = error.what();
    }
  }

  void append(const std::string& line) {
    bool whole = true;  // does the last line end?
    if (std::ifstream in(results_, std::ios::binary | std::ios::ate); in && in.tellg() > 0) {
      in.seekg(-1, std::ios::end);
      whole = in.get() == '\n';
    }
    std::ofstream out(results_, std::ios::app);
    out << (whole ? "" : "\n") << line << "\n" << std::flush;
    if (!out) throw io::WriteError(results_.string() + ": cannot be written");
  }

  void write_tables() const {
    io::write_file_atomically(out_ / "rates.md", rates_text(list()));
    io::write_file_atomically(out_ / "confusion.md", confusion_text(list()));
    io::write_file_atomically(out_ / "cases.md", cases_text(list()));
  }

  const Arguments& a_;
  fs::path out_, results_;
  std::map<int, SceneScore> scores_;
  std::vector<Order> todo_;
  std::mutex mutex_;
  std::string fault_;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Diagnoses measured scenes with something hidden and scores the verdicts."};
  Arguments a;
  app.add_option("--seed", a.seed, "what sizes and noise are drawn from")->capture_default_str();
  const int all = static_cast<int>(orders().size());
  app.add_option("--first", a.first, "number of the first case")->check(CLI::Range(0, all - 1));
  app.add_option("--count", a.count, "how many cases")->check(CLI::Range(1, all));
  app.add_option("--case", a.cases, "these numbers only")->check(CLI::Range(0, all - 1));
  app.add_option("--kind", a.kind, "cases of this kind only")
      ->check(CLI::IsMember({"null", "effect", "pair", "outside"}));
  app.add_option("--threads", a.threads, "cases side by side")->check(CLI::Range(1, 1024));
  app.add_option("--out", a.out, "folder of the results")->capture_default_str();
  app.add_flag("--keep", a.keep, "keep the experiment folders");
  CLI11_PARSE(app, argc, argv);
  hear_stop_signals();
  stop_in_good_order();
  try {
    return Bench(a).run();
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_failure;
  }
}
