#include "tests/discrepancy/harvest/hidden_stalk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/temporary_folder.h"

namespace pedicel::harvest {
namespace {

// One of the stalks of `stalks`, made by another engine and felt by the robot alone.
TEST(HiddenStalk, IsFoundFromWrenchAndJointsAlone) {
  const TemporaryFolder folder;
  const StalkTold stalk = look_at_stalk(folder / "stalk", 1, 2);
  const std::string told = table({stalk}) + stalk.findings;
  ASSERT_EQ(stalk.hold.size(), 2u) << told;
  for (const Told& one : stalk.hold) EXPECT_LT(std::abs(one.off), hold_aim) << told;
  ASSERT_TRUE(stalk.attachment && stalk.modulus) << told;
  EXPECT_LT(stalk.attachment->off, hold_aim) << told;
  EXPECT_LT(std::abs(stalk.modulus->off), modulus_aim) << told;
  ASSERT_EQ(stalk.moment.size(), 2u) << told;
  for (const Told& one : stalk.moment) EXPECT_LT(std::abs(one.off), moment_aim) << told;
}

}  // namespace
}  // namespace pedicel::harvest
