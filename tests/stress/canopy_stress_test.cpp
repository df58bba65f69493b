// Plants that stand in each other, pulled, rammed, tied and cut by seed: canopy_run.h says what is
// a fault.
#include <gtest/gtest.h>

#include "tests/stress/canopy_run.h"

namespace pedicel::stress {
namespace {

constexpr int seeds_per_test = 20, tests = 5;

class CanopyStress : public testing::TestWithParam<int> {};

TEST_P(CanopyStress, NeverExplodesAndBitsDoNotDependOnThreads) {
  long contacts = 0;
  for (int i = 0; i < seeds_per_test; ++i) {
    const int seed = seeds_per_test * GetParam() + i + 1;
    const CanopyOutcome one = run_canopy(seed, 1);
    EXPECT_EQ(one.fault, "") << one.description << "\nalone: tools/stress --canopies 1 " << seed;
    if (i % 4 == 0) {
      EXPECT_EQ(run_canopy(seed, 2).hash, one.hash) << "seed " << seed;
    }
    contacts += one.contacts;
  }
  EXPECT_GT(contacts, 1000);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CanopyStress, testing::Range(0, tests));

}  // namespace
}  // namespace pedicel::stress
