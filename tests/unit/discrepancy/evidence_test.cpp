// What numbers cost, and which causes turned into others, from fits that are written down.
#include "plugins/discrepancy/select/evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {
namespace {

constexpr double sharp = 1.0e3;  // noise units an unknown

/// A fit whose numbers the data tell apart, each to 1/sharp of its unknown.
FitSummary fit_of(const Hypothesis& hypothesis) {
  FitSummary fit;
  fit.hypothesis = hypothesis;
  fit.jacobian = sharp * Eigen::MatrixXd::Identity(hypothesis.size(), hypothesis.size());
  fit.why = "written down";
  return fit;
}

double cost_of_one(const Hypothesis& hypothesis, int p) {
  return 0.5 * std::log1p(std::pow(sharp * hypothesis.free[p].width(), 2));
}

Hypothesis sensor(const Vec3& offset) {
  return effects::Start("force_gain")
      .positive("gain", 1.02, 0.1, 10.0)
      .vector("offset", offset, 0.01, 100);
}

// Laplace: ln sqrt(1 + (width j)^2) a number. An offset at zero adds as much to the density there,
// and so a gain costs what it costs alone; one that is ten deviations away is paid for.
TEST(Evidence, AnOffsetThatIsNotNeededIsFree) {
  const Hypothesis none = sensor(Vec3::Zero());
  EXPECT_NEAR(cost_of_numbers(fit_of(none), 1.0), cost_of_one(none, 0), 1e-9);
  const Hypothesis away = sensor(Vec3(0.01 * 10.0 / sharp, 0, 0));
  double all = 0.0;
  for (int p = 0; p < away.size(); ++p) all += cost_of_one(away, p);
  EXPECT_NEAR(cost_of_numbers(fit_of(away), 1.0), std::min(all, cost_of_one(away, 0) + 50.0), 1e-3);
}

TEST(Evidence, TheOnlySizeOfACauseIsPaidFor) {
  const Hypothesis offset = effects::Start("marker_offset")
                                .word("marker", "m1")
                                .vector("offset", Vec3::Zero(), 1e-3, 0.2);
  EXPECT_NEAR(cost_of_numbers(fit_of(offset), 1.0), 3.0 * cost_of_one(offset, 0), 1e-9);
}

// Twice the noise variance is left: the data say half as much.
TEST(Evidence, WhatIsLeftMakesDataSayLess) {
  const Hypothesis drag = effects::Start("leaf_drag").positive("drag_area", 0.05, 1e-5, 10.0);
  const double width = drag.free[0].width();
  EXPECT_NEAR(cost_of_numbers(fit_of(drag), 2.0), 0.5 * std::log1p(std::pow(sharp * width, 2) / 2),
              1e-9);
}

Candidate memory(const std::string& cause, double time, double cost) {
  Candidate c;
  c.cause = cause;
  const bool creep = cause == "creep";
  c.fit = fit_of(effects::Start(cause)
                     .positive("fraction", 0.1, 1e-3, 0.95)
                     .positive("time", time, creep ? 5.0 : 0.005, creep ? 250.0 : 5.0));
  c.fit.cost = cost;
  c.whole = true;
  return c;
}

// Five seconds long: relaxation that ends there is creep if it does worse by a deviation; one that
// does as well there leaves open which of both it is, one that has its own time is another
// explanation.
TEST(Evidence, ACauseThatEndsWhereAnotherBeginsIsThatOne) {
  FitSummary base;
  base.cost = 600.0;
  const auto limit_of = [&](double time, double cost) {
    std::vector<Candidate> two{memory("relaxation", time, cost), memory("creep", 20.0, 500.5)};
    weigh(two, base, 1000, 1.0, {});
    const Candidate& relaxation = two[two[0].cause == "relaxation" ? 0 : 1];
    if (!relaxation.limit_of.empty()) {
      EXPECT_EQ(two[0].cause, "creep");
      EXPECT_LE(relaxation.evidence, two[0].evidence);
    }
    return relaxation.limit_of;
  };
  EXPECT_EQ(limit_of(5.0, 501.0), "creep");
  EXPECT_EQ(limit_of(5.0, 500.9), "");
  EXPECT_EQ(limit_of(5.0, 500.0), "");
  EXPECT_EQ(limit_of(5.0, 490.0), "");
  EXPECT_EQ(limit_of(2.0, 501.0), "");
}

// Beside nothing it is what any cause must be worth. Measured where 112 elements were pulled by
// tens of times the noise: a weak segment that brought 30,126 nats left 26 that are none; a soft
// foot of 87,792 left a drag of 673 that is one.
TEST(Evidence, AnotherCauseMustBringMoreThanTwoSolversDifferBy) {
  const auto beside = [](const std::string& cause, double gain) {
    Candidate found;
    found.cause = cause;
    found.gain = gain;
    return least_gain_beside({found}, {});
  };
  EXPECT_DOUBLE_EQ(least_gain_beside({}, {}), Levels{}.worth_naming);
  EXPECT_GT(beside("weak_segment", 30126.0), 2.0 * 26.0);
  EXPECT_LT(beside("base_compliance", 87792.0), 0.5 * 673.0);
  // Solvers do not differ about what a sensor does.
  EXPECT_DOUBLE_EQ(beside("marker_scale", 3.0e6), Levels{}.worth_naming);
  EXPECT_GT(beside("grip_compliance", 3.0e6), 1000.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
