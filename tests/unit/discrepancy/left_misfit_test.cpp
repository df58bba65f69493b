// How much of the misfit is left, by known sums.
#include "plugins/discrepancy/select/left_misfit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pedicel::discrepancy {
namespace {

TEST(LeftMisfit, IsAShareOfWhatTheRefittedModelLeavesAboveTheNoise) {
  // 1,000 samples of markers, and of a force that shows nothing.
  const InstrumentSums fit{{"position", {11000.0, 2000.0, 4000.0, 1000.0}},
                           {"force", {1010.0, 1000.0, 1000.0, 1000.0}}};
  const LeftMisfit left = left_misfit(fit, {{"position", {6000.0, 1000.0, 1000.0, 1000.0}}});
  EXPECT_NEAR(*left.share.fit, 1000.0 / 10010.0, 1.0e-12);
  EXPECT_DOUBLE_EQ(*left.share.check, 0.0);
  EXPECT_DOUBLE_EQ(*left.times_noise.fit, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(*left.times_noise.check, 1.0);
  ASSERT_EQ(left.channels.size(), 2u);
  EXPECT_EQ(left.channels[0].name, "force");
  EXPECT_FALSE(left.channels[0].share) << "noise alone comes to as much";
  EXPECT_EQ(left.channels[1].name, "position");
  EXPECT_NEAR(*left.channels[1].share, 1000.0 / 15000.0, 1.0e-12);
  EXPECT_DOUBLE_EQ(*left.channels[1].times_noise, std::sqrt(2.5));
}

TEST(LeftMisfit, IsNothingWithoutTrials) {
  const LeftMisfit left = left_misfit({{"pixel", {}}}, {});
  EXPECT_FALSE(left.share.fit || left.share.check || left.times_noise.fit);
  EXPECT_TRUE(left.channels.empty());
}

}  // namespace
}  // namespace pedicel::discrepancy
