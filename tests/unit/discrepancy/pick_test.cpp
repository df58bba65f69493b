#include "pedicel/discrepancy/simulate/pick.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pedicel::discrepancy {
namespace {

/// Rises in a second to 10 N above a weight of 3 N and falls in `fall` seconds.
Samples pull(double fall) {
  Samples force;
  for (int i = 0; i < 1000; ++i) force.time.push_back(0.004 * i);
  force.value.resize(1000, 3);
  for (int i = 0; i < 1000; ++i) {
    const double t = force.time[i];
    const double f = t < 0.5 ? 0.0 : t < 1.5 ? 10.0 * (t - 0.5) : 10.0 * (1.0 - (t - 1.5) / fall);
    force.value.row(i) << 0.6 * std::max(f, 0.0), 0.8 * std::max(f, 0.0), -3.0;
  }
  return force;
}

TEST(Pick, TimeToHalfIsThatOfTheFall) {
  for (const double fall : {0.04, 0.4}) {
    const Pick pick = judge_pick(pull(fall));
    EXPECT_NEAR(pick.peak_force, 10.0, 0.05);
    EXPECT_NEAR(pick.time_to_half, 0.5 * fall, 0.004);
  }
}

TEST(Pick, ToldApartByIt) {
  EXPECT_EQ(judge_pick(pull(0.04)).end, Pick::End::detached);
  EXPECT_EQ(judge_pick(pull(0.4)).end, Pick::End::slipped);
}

TEST(Pick, UnclearWhereNothingHappened) {
  EXPECT_EQ(judge_pick({}).end, Pick::End::unclear);
  Samples still = pull(0.4);
  still.value.rowwise() = Eigen::RowVector3d(0, 0, -3);
  EXPECT_EQ(judge_pick(still).end, Pick::End::unclear);
  Samples cut = pull(0.4);  // ends while it is still held
  cut.time.resize(380);
  cut.value.conservativeResize(380, 3);
  EXPECT_EQ(judge_pick(cut).end, Pick::End::unclear);
}

TEST(Pick, PassesOverGaps) {
  Samples force = pull(0.04);
  force.value.row(100).setConstant(NAN);
  force.value.row(375).setConstant(NAN);
  EXPECT_EQ(judge_pick(force).end, Pick::End::detached);
}

}  // namespace
}  // namespace pedicel::discrepancy
