#include "tests/stress/seeds.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "engine/cluster/campaign.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/thread_pool.h"
#include "engine/io/atomic_file.h"
#include "plugins/cosserat/lanes/instruction_set.h"

namespace pedicel::stress {

namespace {

namespace fs = std::filesystem;

struct Arguments {
  int count = 0, first = 1;
  std::string out, instruction_set;
  cluster::ClusterOptions cluster;
};

constexpr const char* file_name = "seeds.jsonl";

std::string to_line(const SeedResult& result) {
  return nlohmann::json{{"seed", result.seed},
                        {"passed", result.passed},
                        {"text", result.text},
                        {"figures", result.figures}}
             .dump() +
         "\n";
}

// What is not finite has no word in JSON.
SeedResult of_line(const std::string& line) {
  const auto json = nlohmann::json::parse(line);
  SeedResult result{json.at("seed"), json.at("passed"), json.at("text"), {}};
  for (const auto& figure : json.at("figures"))
    result.figures.push_back(figure.is_number() ? figure.get<double>()
                                                : std::numeric_limits<double>::quiet_NaN());
  return result;
}

std::vector<SeedResult> here(const Arguments& a, const SeedProgram& program) {
  std::vector<SeedResult> results(a.count);
  ThreadPool pool(a.out.empty() ? std::max(1, static_cast<int>(std::thread::hardware_concurrency()))
                                : 1);
  pool.for_each(a.count, [&](int i) {
    if (stop_requested) return;
    results[i] = program.run(a.first + i);
    if (!results[i].passed || a.count == 1) std::printf("%s\n", results[i].text.c_str());
  });
  throw_if_stopped();
  return results;
}

cluster::ProgramAbout about() {
  return {PEDICEL_VERSION, "", cosserat::checked_instruction_set};
}

cluster::Plan plan_of(const Arguments& a, const SeedProgram& program, const CLI::App& app) {
  cluster::Plan plan;
  plan.verb = program.name;
  plan.common = {"--out={out}"};
  plan.again = cluster::words_of_same_call(app);
  plan.results = {exit_ok, exit_failure};
  plan.instruction_set = a.instruction_set;
  for (int first = a.first; first < a.first + a.count; first += program.seeds_of_a_case) {
    const int count = std::min(program.seeds_of_a_case, a.first + a.count - first);
    plan.cases.push_back(
        {"seeds " + std::to_string(first) + " to " + std::to_string(first + count - 1),
         {std::to_string(count), std::to_string(first)}});
  }
  return plan;
}

/// Of the cases that are done; those that are not are told.
std::vector<SeedResult> as_tasks(const Arguments& a, const SeedProgram& program,
                                 const CLI::App& app) {
  stop_in_good_order();
  const fs::path out = a.out.empty() ? "out/" + program.name : a.out;
  cluster::Campaign campaign(out / "cluster", plan_of(a, program, app),
                             cluster::with_profile(a.cluster), about());
  campaign.run([](const std::string& what, double) { std::fprintf(stderr, "%s\n", what.c_str()); },
               [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); });
  std::vector<SeedResult> results;
  for (std::size_t i = 0; i < campaign.tasks().cases.size(); ++i) {
    const auto from = campaign.output(static_cast<int>(i));
    if (!from) continue;
    std::istringstream lines(io::read_file(*from / file_name));
    for (std::string line; std::getline(lines, line);) results.push_back(of_line(line));
  }
  for (const SeedResult& result : results)
    if (!result.passed) std::printf("%s\n", result.text.c_str());
  if (!campaign.missing_text().empty() && !a.cluster.no_wait)
    throw std::runtime_error(campaign.missing_text());
  return results;
}

int run(const Arguments& a, const SeedProgram& program, const CLI::App& app) {
  cosserat::choose_instruction_set(a.instruction_set);
  const bool tasks = a.cluster.wanted() || !a.cluster.profile.empty();
  const std::vector<SeedResult> results = tasks ? as_tasks(a, program, app) : here(a, program);
  throw_if_stopped();
  if (results.empty()) return exit_ok;
  if (!tasks && !a.out.empty()) {
    std::string text;
    for (const SeedResult& result : results) text += to_line(result);
    io::write_file_atomically(fs::path(a.out) / file_name, text);
  }
  program.tell(results);
  const auto passed = std::ranges::count_if(results, &SeedResult::passed);
  std::printf("%d of %d seeds passed\n", static_cast<int>(passed),
              static_cast<int>(results.size()));
  return std::cmp_equal(passed, results.size()) ? exit_ok : exit_failure;
}

}  // namespace

void print_worst(const std::vector<SeedResult>& results, const char* what, std::size_t figure) {
  const auto worst = std::ranges::max_element(
      results, {}, [figure](const SeedResult& result) { return result.figures[figure]; });
  std::printf("%s %.3g (seed %d)\n", what, worst->figures[figure], worst->seed);
}

int seeds_main(int argc, char** argv, const SeedProgram& program) {
  if (const auto code = cluster::run_as_task(argc, argv, about())) return *code;
  CLI::App app{program.help};
  Arguments a;
  a.count = program.count;
  app.add_option("count", a.count, "how many seeds")
      ->check(CLI::Range(1, cluster::most_cases))
      ->capture_default_str();
  app.add_option("first", a.first, "the first one")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--out", a.out, "folder for seeds.jsonl, a line a seed, done one after the other");
  app.add_option("--instruction-set", a.instruction_set, "that rods are solved with");
  cluster::add_cluster_options(app, a.cluster);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
  }
  hear_stop_signals();
  try {
    return run(a, program, app);
  } catch (const Stopped&) {
    return stop_exit_code();
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_failure;
  }
}

}  // namespace pedicel::stress
