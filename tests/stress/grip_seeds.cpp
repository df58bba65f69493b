// The program behind tools/stress --grips.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "tests/stress/grip_run.h"
#include "tests/stress/seeds.h"
#include "tests/stress/sentence.h"

namespace {

using namespace pedicel::stress;

// Figures of a grip, in this order.
enum : std::size_t { force, sunk, friction, seconds, unsolved, gripped, lost, broken };

SeedResult run_seed(int seed) {
  const GripCase one = draw_grip(seed);
  GripOutcome o;
  try {
    o = run_grip(one);
  } catch (const std::exception& error) {
    o.fault = error.what();
  }
  const bool passed = o.fault.empty();
  return {
      seed,
      passed,
      describe(one) + ": " + (passed ? "passed" : o.fault) +
          sentence("\n  force %.3g, sunk %.3g, friction %.3g, %d steps unsolved, %s%s%s",
                   o.force_used, o.sunk, o.friction_used, o.unsolved,
                   o.gripped ? "gripped" : "not gripped", o.lost ? ", lost" : "",
                   o.broken ? ", broken" : ""),
      {o.force_used, o.sunk, o.friction_used, o.seconds, static_cast<double>(o.unsolved),
       static_cast<double>(o.gripped), static_cast<double>(o.lost), static_cast<double>(o.broken)}};
}

double sum_of(const std::vector<SeedResult>& results, std::size_t figure) {
  double sum = 0.0;
  for (const SeedResult& result : results) sum += result.figures[figure];
  return sum;
}

void tell(const std::vector<SeedResult>& results) {
  print_worst(results, "largest force of that which the joint has:", force);
  print_worst(results, "deepest overlap of the radius:", sunk);
  print_worst(results, "longest run, s:", seconds);
  std::printf("%.0f steps unsolved; gripped %.0f, slid out %.0f, broken %.0f\n",
              sum_of(results, unsolved), sum_of(results, gripped), sum_of(results, lost),
              sum_of(results, broken));
}

}  // namespace

int main(int argc, char** argv) {
  return seeds_main(argc, argv,
                    {"grips", "Grippers that shut on plants, by seed.", 500, 5, run_seed, tell});
}
