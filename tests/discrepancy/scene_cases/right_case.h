#pragma once

#include <cstdint>
#include <string>

namespace pedicel::scene_case {

/// Makes case `number` of `scene_bench --seed SEED`, diagnoses it from its files alone, and fails
/// the test that runs unless the verdict is right: exactly what is hidden, and within 3 cm the
/// place of something outside.
void expect_right(std::uint64_t seed, int number);

/// "13_payload", "21_nothing": the case's number and what is hidden, as a test's name.
std::string test_name(int number);

}  // namespace pedicel::scene_case
