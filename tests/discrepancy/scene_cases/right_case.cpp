#include "tests/discrepancy/scene_cases/right_case.h"

#include <gtest/gtest.h>

#include "tests/discrepancy/scene_cases/scored_case.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::scene_case {

void expect_right(std::uint64_t seed, int number) {
  const Order order = orders().at(static_cast<std::size_t>(number));
  const TemporaryFolder folder;
  std::string notes;
  const SceneScore score = run_case(order, seed, folder / "", 2, notes);
  EXPECT_EQ(score.call, "right") << notes;
  if (score.kind != "outside") {
    EXPECT_EQ(score.said, score.hidden) << notes;
    return;
  }
  ASSERT_TRUE(score.place_off) << notes;
  EXPECT_LT(*score.place_off, 0.03) << notes;
}

std::string test_name(int number) {
  const Order order = orders().at(static_cast<std::size_t>(number));
  std::string name = std::to_string(number);
  for (const std::string& hidden : order.names) name += "_" + hidden;
  return order.names.empty() ? name + "_nothing" : name;
}

}  // namespace pedicel::scene_case
