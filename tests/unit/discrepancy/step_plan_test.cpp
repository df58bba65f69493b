#include "plugins/discrepancy/simulate/step_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace pedicel::discrepancy {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(StepPlan, EveryJumpIsTheEndOfAStep) {
  const double events[] = {0.71, 0.2, -infinite, infinite, 0.2, 0.0, 3.0};
  const StepPlan plan = make_step_plan(events, 0.03, 1.0, infinite);
  // 7 steps to 0.2, 17 to 0.71, 10 to 1.
  ASSERT_EQ(plan.steps(), 34);
  EXPECT_EQ(plan.time[7], 0.2);
  EXPECT_EQ(plan.time[24], 0.71);
  EXPECT_EQ(plan.time.back(), 1.0);
  for (int k = 0; k < plan.steps(); ++k) {
    EXPECT_LE(plan.dt[k], 0.03 * (1.0 + 1.0e-9));
    EXPECT_NEAR(plan.time[k + 1] - plan.time[k], plan.dt[k], 1.0e-15);
    EXPECT_EQ(plan.restart[k], k == 7 || k == 24) << k;
  }
}

TEST(StepPlan, AShorterOneIsTheBeginningOfTheWhole) {
  const double events[] = {0.5};
  const StepPlan whole = make_step_plan(events, 0.03, 1.0, infinite);
  const StepPlan part = make_step_plan(events, 0.03, 1.0, 0.7);
  ASSERT_LT(part.steps(), whole.steps());
  EXPECT_GE(part.time.back(), 0.7);
  EXPECT_LT(part.time.back(), 0.73);
  for (int k = 0; k < part.steps(); ++k) {
    EXPECT_EQ(part.time[k], whole.time[k]);
    EXPECT_EQ(part.dt[k], whole.dt[k]);
  }
}

TEST(StepPlan, GoesOnBeyondTheEnd) {
  const StepPlan plan = make_step_plan({}, 0.1, 1.0, 1.25);
  EXPECT_EQ(plan.steps(), 13);
  EXPECT_NEAR(plan.time.back(), 1.3, 1.0e-12);
}

// Steps of 0.1 s, of which up to four are one in the quiet spans. Jumps stay ends of steps, and
// neighbours differ by a factor of two at most, down to the end of a span, too.
TEST(StepPlan, QuietSpansHaveLongSteps) {
  const double events[] = {2.0};
  const TimeSpan quiet[] = {{0.5, 2.6}, {3.1, 3.3}};
  const StepPlan plan = make_step_plan(events, 0.1, 4.0, infinite, quiet, 4);
  std::vector<double> longest;
  for (int k = 0; k < plan.steps(); ++k) {
    EXPECT_NEAR(plan.time[k + 1] - plan.time[k], plan.dt[k], 1.0e-12);
    if (k > 0 && plan.restart[k] == 0) {
      const double ratio = plan.dt[k] / plan.dt[k - 1];
      EXPECT_LE(ratio, 2.0 + 1.0e-9) << k;
      EXPECT_GE(ratio, 0.5 - 1.0e-9) << k;
    }
    const bool within = plan.time[k] >= 0.5 - 1e-9 && plan.time[k + 1] <= 2.6 + 1e-9;
    if (!within) {
      EXPECT_NEAR(plan.dt[k], 0.1, 1.0e-9) << plan.time[k];
    }
  }
  EXPECT_NEAR(*std::ranges::max_element(plan.dt), 0.4, 1.0e-9);
  EXPECT_NE(std::ranges::find(plan.time, 2.0), plan.time.end());
  EXPECT_EQ(plan.time.back(), 4.0);
  EXPECT_LT(plan.steps(), 34);
  const StepPlan part = make_step_plan(events, 0.1, 4.0, 1.7, quiet, 4);
  for (int k = 0; k < part.steps(); ++k) EXPECT_EQ(part.time[k + 1], plan.time[k + 1]);
}

TEST(StepPlan, ATrialOfOneInstantHasNoSteps) {
  EXPECT_EQ(make_step_plan({}, 0.1, 0.0, infinite).steps(), 0);
}

}  // namespace
}  // namespace pedicel::discrepancy
