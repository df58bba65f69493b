// The lane solver against the plain one, on random plants: README.md says what is drawn and judged.
#include <gtest/gtest.h>

#include "tests/property/rods/garden_check.h"

namespace pedicel::plain {
namespace {

constexpr int seeds_per_test = 5, tests = 20;

class Gardens : public testing::TestWithParam<int> {};

TEST_P(Gardens, TheLanesSolveAsThePlainSolverDoes) {
  for (int i = 0; i < seeds_per_test; ++i) {
    const Garden garden = draw_garden(seeds_per_test * GetParam() + i + 1);
    EXPECT_EQ(check_garden(garden).fault, "")
        << describe(garden) << "\nalone: tools/gardens 1 " << garden.seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Gardens, testing::Range(0, tests));

}  // namespace
}  // namespace pedicel::plain
