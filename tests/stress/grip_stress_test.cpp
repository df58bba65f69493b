// Grippers that shut on stems, stalks and fruits, drag, turn and shake them, by seed: see
// README.md.
#include <gtest/gtest.h>

#include "tests/stress/grip_run.h"

namespace pedicel::stress {
namespace {

constexpr int seeds_per_test = 5, tests = 4;

class GripStress : public testing::TestWithParam<int> {};

TEST_P(GripStress, HoldsOrBreaks) {
  for (int i = 0; i < seeds_per_test; ++i) {
    const GripCase one = draw_grip(seeds_per_test * GetParam() + i + 1);
    const GripOutcome outcome = run_grip(one);
    EXPECT_EQ(outcome.fault, "") << describe(one) << "\nalone: tools/stress --grips 1 " << one.seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, GripStress, testing::Range(0, tests));

}  // namespace
}  // namespace pedicel::stress
