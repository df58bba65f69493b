// grip_seeds [COUNT [FIRST]]: runs COUNT grips (default 500) from FIRST (default 1) on every core.
// Prints those that fail, how many passed and the worst figures; exit code 1 where one failed.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>
#include <vector>

#include "pedicel/core/thread_pool.h"
#include "stress/grip_run.h"

namespace {

using pedicel::stress::GripOutcome;

void print_worst(const std::vector<GripOutcome>& outcomes, int first, const char* what,
                 double GripOutcome::*figure) {
  const auto worst = std::max_element(
      outcomes.begin(), outcomes.end(),
      [&](const GripOutcome& a, const GripOutcome& b) { return a.*figure < b.*figure; });
  std::printf("%s %.3g (seed %d)\n", what, (*worst).*figure,
              first + static_cast<int>(worst - outcomes.begin()));
}

GripOutcome run(int seed, bool tell) {
  const pedicel::stress::GripCase one = pedicel::stress::draw_grip(seed);
  GripOutcome outcome;
  try {
    outcome = run_grip(one);
  } catch (const std::exception& error) {
    outcome.fault = error.what();
  }
  if (tell || !outcome.fault.empty())
    std::printf("%s: %s\n  force %.3g, sunk %.3g, friction %.3g, %d steps unsolved, %s%s%s\n",
                describe(one).c_str(), outcome.fault.empty() ? "passed" : outcome.fault.c_str(),
                outcome.force_used, outcome.sunk, outcome.friction_used, outcome.unsolved,
                outcome.gripped ? "gripped" : "not gripped", outcome.lost ? ", lost" : "",
                outcome.broken ? ", broken" : "");
  return outcome;
}

int count_of(const std::vector<GripOutcome>& outcomes, bool GripOutcome::*flag) {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(),
                                        [&](const GripOutcome& one) { return one.*flag; }));
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 500, first = argc > 2 ? std::atoi(argv[2]) : 1;
  if (count < 1 || first < 0) {
    std::fprintf(stderr, "usage: grip_seeds [COUNT [FIRST]], COUNT from 1, FIRST from 0\n");
    return 2;
  }
  std::vector<GripOutcome> outcomes(count);
  pedicel::ThreadPool pool(std::max(1u, std::thread::hardware_concurrency()));
  pool.for_each(count, [&](int i) { outcomes[i] = run(first + i, count == 1); });
  const auto passed = std::count_if(outcomes.begin(), outcomes.end(),
                                    [](const GripOutcome& one) { return one.fault.empty(); });
  print_worst(outcomes, first,
              "largest force of that which the joint has:", &GripOutcome::force_used);
  print_worst(outcomes, first, "deepest overlap of the radius:", &GripOutcome::sunk);
  print_worst(outcomes, first, "longest run, s:", &GripOutcome::seconds);
  long unsolved = 0;
  for (const GripOutcome& one : outcomes) unsolved += one.unsolved;
  std::printf("%ld steps unsolved; gripped %d, slid out %d, broken %d\n", unsolved,
              count_of(outcomes, &GripOutcome::gripped), count_of(outcomes, &GripOutcome::lost),
              count_of(outcomes, &GripOutcome::broken));
  std::printf("%d of %d seeds passed\n", static_cast<int>(passed), count);
  return passed == count ? 0 : 1;
}
