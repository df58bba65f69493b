// garden_seeds [COUNT [FIRST [MOST]]]: checks COUNT gardens (default 1000) from seed FIRST (default
// 1), of at most MOST elements (default 20000) a plant. Prints those that fail, how many passed and
// the worst figures; exit code 1 where one failed.
#include <cstdio>
#include <cstdlib>

#include "tests/property/rods/garden_check.h"

int main(int argc, char** argv) {
  using namespace pedicel::plain;
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000, first = argc > 2 ? std::atoi(argv[2]) : 1,
            most = argc > 3 ? std::atoi(argv[3]) : 20000;
  if (count < 1 || first < 0 || most < 1) {
    std::fprintf(
        stderr,
        "usage: garden_seeds [COUNT [FIRST [MOST]]], COUNT and MOST from 1, FIRST from 0\n");
    return 2;
  }
  Outcome worst;
  int passed = 0;
  for (int seed = first; seed < first + count; ++seed) {
    const Garden garden = draw_garden(seed, most);
    const Outcome outcome = check_garden(garden);
    passed += outcome.fault.empty();
    worst.residual = std::max(worst.residual, outcome.residual);
    worst.change = std::max(worst.change, outcome.change);
    worst.distance = std::max(worst.distance, outcome.distance);
    worst.solved += outcome.solved;
    worst.steps += outcome.steps;
    worst.valleys += outcome.valleys;
    if (outcome.fault.empty() && count > 1) continue;
    std::printf("%s: %s\n", describe(garden).c_str(),
                outcome.fault.empty() ? "passed" : outcome.fault.c_str());
    std::fflush(stdout);
  }
  std::printf(
      "residual %.3g, change left %.3g, distance %.3g of what is allowed; %d of %d steps solved, "
      "%d in another valley\n",
      worst.residual, worst.change, worst.distance, worst.solved, worst.steps, worst.valleys);
  std::printf("%d of %d seeds passed\n", passed, count);
  return passed == count ? 0 : 1;
}
