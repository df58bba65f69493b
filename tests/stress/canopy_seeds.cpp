// canopy_seeds [COUNT [FIRST]]: runs COUNT canopies (default 500) from FIRST (default 1) on every
// core, each on one thread and on two. Prints those that fail, and how many passed; exit code 1
// where one failed.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "engine/core/thread_pool.h"
#include "tests/stress/canopy_run.h"

int main(int argc, char** argv) {
  using pedicel::stress::CanopyOutcome;
  const int count = argc > 1 ? std::atoi(argv[1]) : 500, first = argc > 2 ? std::atoi(argv[2]) : 1;
  if (count < 1 || first < 0) {
    std::fprintf(stderr, "usage: canopy_seeds [COUNT [FIRST]], COUNT from 1, FIRST from 0\n");
    return 2;
  }
  std::atomic<int> passed{0};
  std::atomic<long> contacts{0};
  pedicel::ThreadPool pool(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  pool.for_each(count, [&](int i) {
    CanopyOutcome outcome = pedicel::stress::run_canopy(first + i, 1);
    if (outcome.fault.empty() && pedicel::stress::run_canopy(first + i, 2).hash != outcome.hash)
      outcome.fault = "other bits on two threads";
    contacts += outcome.contacts;
    if (outcome.fault.empty()) ++passed;
    if (!outcome.fault.empty() || count == 1)
      std::printf("seed %d: %s\n  %s, %ld contacts, imbalance %.3g N\n", first + i,
                  outcome.fault.empty() ? "passed" : outcome.fault.c_str(),
                  outcome.description.c_str(), outcome.contacts, outcome.imbalance);
  });
  std::printf("%d of %d seeds passed, %ld contacts\n", passed.load(), count, contacts.load());
  return passed == count ? 0 : 1;
}
