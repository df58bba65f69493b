// The program behind tools/stress.
#include "tests/stress/seeds.h"
#include "tests/stress/stress_run.h"

namespace {

using namespace pedicel::stress;

SeedResult run_seed(int seed) {
  const StressCase one = draw_case(seed);
  const Outcome outcome = run_case(one);
  const bool passed = outcome.fault.empty();
  return {seed,
          passed,
          describe(one) + ": " + (passed ? "passed" : outcome.fault),
          {outcome.excess, outcome.strain_used, outcome.strain}};
}

void tell(const std::vector<SeedResult>& results) {
  print_worst(results, "energy beyond what was put in, 1 is the most:", 0);
  print_worst(results, "strain against its bound, 1 is the most:", 1);
  print_worst(results, "largest stretch and shear strain:", 2);
}

}  // namespace

int main(int argc, char** argv) {
  return seeds_main(argc, argv,
                    {"stress", "Plants through random ordeals by seed.", 1000, 20, run_seed, tell});
}
