// Leaving out a trial of a linear model is the least squares fit to the others, solved here anew.
#include "plugins/discrepancy/test/leave_one_out.h"

#include <gtest/gtest.h>

#include <array>

#include "engine/core/random.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {
namespace {

constexpr std::array<Eigen::Index, 3> rows{20, 30, 25};

// A linear model of two numbers, fitted to 75 samples.
FitSummary linear_fit() {
  Random random(5);
  FitSummary fit;
  fit.hypothesis = effects::Start("leaf_drag").positive("drag_area", 0.05, 1e-5, 10.0);
  fit.hypothesis.add(effects::Start("relaxation").positive("fraction", 0.1, 1e-3, 0.9));
  fit.jacobian.resize(75, 2);
  for (double& x : fit.jacobian.reshaped()) x = random.normal();
  fit.residual.resize(75);
  for (double& x : fit.residual) x = random.normal();
  fit.residual = projected_out(fit.jacobian, fit.residual);
  return fit;
}

TEST(LeaveOneOut, IsTheFitToTheOtherTrials) {
  const FitSummary fit = linear_fit();
  const std::vector<LeftOut> found = leave_one_out(fit, rows);
  ASSERT_EQ(found.size(), rows.size());
  Eigen::Index first = 0;
  for (std::size_t t = 0; t < rows.size(); ++t) {
    Eigen::MatrixXd jacobian(75 - rows[t], 2);
    Eigen::VectorXd residual(75 - rows[t]);
    jacobian << fit.jacobian.topRows(first), fit.jacobian.bottomRows(75 - first - rows[t]);
    residual << fit.residual.head(first), fit.residual.tail(75 - first - rows[t]);
    EXPECT_LT((found[t].moved - least_squares_step(jacobian, residual)).norm(), 1e-12);
    EXPECT_NEAR(found[t].cost, 0.5 * projected_out(jacobian, residual).squaredNorm(), 1e-12);
    first += rows[t];
  }
}

TEST(LeaveOneOut, WhatStandsAtABoundStays) {
  FitSummary fit = linear_fit();
  fit.at_bound = {1};
  for (const LeftOut& without : leave_one_out(fit, rows)) {
    EXPECT_NE(without.moved[0], 0.0);
    EXPECT_EQ(without.moved[1], 0.0);
  }
}

// What is known to a millionth beforehand moves no more than that, whatever the data say.
TEST(LeaveOneOut, WhatIsKnownBeforehandHolds) {
  FitSummary fit = linear_fit();
  FreeParameter& known = fit.hypothesis.free[0];
  known.prior = 1e-6;
  known.prior_centre = fit.hypothesis.value(0);
  for (const LeftOut& without : leave_one_out(fit, rows))
    EXPECT_LT(std::abs(without.moved[0]), 1e-9);
}

}  // namespace
}  // namespace pedicel::discrepancy
