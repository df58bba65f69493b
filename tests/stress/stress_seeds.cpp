// stress_seeds [COUNT [FIRST]]: runs COUNT seeds (default 1000) from FIRST (default 1) on every
// core. Prints those that fail, how many passed and the worst figures; exit code 1 where one
// failed.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "pedicel/core/thread_pool.h"
#include "stress/stress_run.h"

namespace {

using pedicel::stress::Outcome;

void print_worst(const std::vector<Outcome>& outcomes, int first, const char* what,
                 double Outcome::*figure) {
  const auto worst =
      std::max_element(outcomes.begin(), outcomes.end(),
                       [&](const Outcome& a, const Outcome& b) { return a.*figure < b.*figure; });
  std::printf("%s %.3g (seed %d)\n", what, (*worst).*figure,
              first + static_cast<int>(worst - outcomes.begin()));
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000, first = argc > 2 ? std::atoi(argv[2]) : 1;
  if (count < 1 || first < 0) {
    std::fprintf(stderr, "usage: stress_seeds [COUNT [FIRST]], COUNT from 1, FIRST from 0\n");
    return 2;
  }
  std::vector<Outcome> outcomes(count);
  pedicel::ThreadPool pool(std::max(1u, std::thread::hardware_concurrency()));
  pool.for_each(count, [&](int i) {
    const pedicel::stress::StressCase one = pedicel::stress::draw_case(first + i);
    outcomes[i] = pedicel::stress::run_case(one);
    if (!outcomes[i].fault.empty() || count == 1)
      std::printf("%s: %s\n", describe(one).c_str(),
                  outcomes[i].fault.empty() ? "passed" : outcomes[i].fault.c_str());
  });
  const auto passed = std::count_if(outcomes.begin(), outcomes.end(),
                                    [](const Outcome& outcome) { return outcome.fault.empty(); });
  print_worst(outcomes, first, "energy beyond what was put in, 1 is the most:", &Outcome::excess);
  print_worst(outcomes, first, "strain against its bound, 1 is the most:", &Outcome::strain_used);
  print_worst(outcomes, first, "largest stretch and shear strain:", &Outcome::strain);
  std::printf("%d of %d seeds passed\n", static_cast<int>(passed), count);
  return passed == count ? 0 : 1;
}
