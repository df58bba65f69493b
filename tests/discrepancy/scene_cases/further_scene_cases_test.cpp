#include <gtest/gtest.h>

#include "tests/discrepancy/scene_cases/right_case.h"

namespace pedicel::scene_case {
namespace {

// More cases of `scene_bench --seed 1`: nothing, a post, a string, a plant and a tool that stand
// elsewhere, an encoder's zero, latency with another modulus, a
// reaction, a load, a sensor's bias with another modulus, a sensor's gain, a camera's place, its
// focal length with another modulus, its lens; a load at a plant that stands elsewhere with another
// modulus, and a gain beside a camera's place. Of other records: friction in a joint, alone and
// with another modulus, from torques; nothing and a lag where the arm follows commands; nothing
// where torques are measured.
class FurtherSceneCases : public testing::TestWithParam<int> {};

TEST_P(FurtherSceneCases, ComesOutRight) {
  expect_right(1, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Something, FurtherSceneCases,
                         testing::Values(0, 2, 3, 4, 5, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18,
                                         28, 32, 102, 105, 106, 109, 110),
                         [](const testing::TestParamInfo<int>& info) {
                           return test_name(info.param);
                         });

}  // namespace
}  // namespace pedicel::scene_case
