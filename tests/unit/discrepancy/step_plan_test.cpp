#include "pedicel/discrepancy/simulate/step_plan.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(StepPlan, ATrialOfOneInstantHasNoSteps) {
  EXPECT_EQ(make_step_plan({}, 0.1, 0.0, infinite).steps(), 0);
}

}  // namespace
}  // namespace pedicel::discrepancy
