// Intervals by profile likelihood. Where a prediction is linear in its parameters, the deviance of
// one of them with the others refitted is exactly ((u - best) / s)^2 with s the standard error of
// least squares, so that the interval ends at best +- sqrt(3.841) s: Wald's interval.
#include "plugins/discrepancy/fit/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "plugins/discrepancy/fit/causes.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 3.0e-4;  // m

TEST(ProfileEnd, OfASquareIsFoundAtOnce) {
  const Deviance square = [](double u) { return std::pow((u - 2.0) / 0.1, 2); };
  const ProfileEnd end = profile_end(square, 2.0, 10.0, 0.05, deviance95);
  EXPECT_NEAR(end.unknown, 2.0 + 0.1 * std::sqrt(deviance95), 2e-3);
  EXPECT_FALSE(end.at_bound);
  EXPECT_LE(end.refits, 3);
}

TEST(ProfileEnd, OfABentValleyIsFound) {
  // Steep on one side and nearly flat on the other: the first guess is far off on both.
  const Deviance bent = [](double u) { return 9.0 * std::pow(std::expm1(u), 2); };
  const double low = profile_end(bent, 0.0, -8.0, 0.01, deviance95).unknown;
  const double high = profile_end(bent, 0.0, 8.0, 5.0, deviance95).unknown;
  EXPECT_NEAR(bent(low), deviance95, 0.05 * deviance95);
  EXPECT_NEAR(bent(high), deviance95, 0.05 * deviance95);
}

TEST(ProfileEnd, WithoutAnObjectionIsTheBound) {
  const ProfileEnd end = profile_end([](double) { return 1.0; }, 0.0, -3.0, 0.1, deviance95);
  EXPECT_TRUE(end.at_bound);
  EXPECT_EQ(end.unknown, -3.0);
}

/// A beam that only stands there, and two numbers of its sensors: the tip's marker sits aside by
/// `offset` along y, and the frame is turned about one axis. Turning about x moves the tip along y,
/// too, so that the two share what they explain; what is in the data is linear in both (to a turn's
/// third power).
struct Sensors {
  Experiment experiment = testing::experiment_of({}, 0.2);
  Hypothesis model;

  explicit Sensors(int axis) {
    plant::Effect offset = testing::effect("marker_offset", "offset", {0, 0, 0});
    offset.words["marker"] = "tip";
    model.effects = {offset, testing::effect("frame_rotation", "rotation", {0, 0, 0})};
    model.free = {{0, "offset", 1, false, 1e-3, -0.2, 0.2, "m"},
                  {1, "rotation", axis, false, 0.01, -0.7, 0.7, "rad"}};
    Trial& trial = experiment.trials[0];
    trial.force = {};
    Simulator simulator(experiment, {0.02, 1.0 / 240}, 1);
    const Variant plain;
    const Simulator::Request request{&plain, 0};
    trial.markers.value = simulator.run(std::span(&request, 1)).front().markers;
    Random random(5);
    for (double& x : trial.markers.value.reshaped()) x += noise * random.normal();
  }
};

TEST(Profile, IsWaldsIntervalWhereTheModelIsLinear) {
  const Sensors made(0);
  DataSet data(made.experiment);
  data.set_noise(white_noise(noise), white_noise(1.0));
  Simulator simulator(made.experiment, {0.02, 1.0 / 240}, 1);
  Evaluator evaluator(simulator, data);
  FitOptions options{{0}};
  const FitSummary best = fit(evaluator, made.model, options);
  ASSERT_GT(best.condition, 2.0);  // the others' refit matters
  for (int p = 0; p < 2; ++p) {
    const Profile found = profile(evaluator, best, p, options);
    const double wald = std::sqrt(deviance95) * best.standard_error[p];
    const double at = best.hypothesis.unknowns()[p];
    EXPECT_NEAR((at - found.low.unknown) / wald, 1.0, 0.02) << p;
    EXPECT_NEAR((found.high.unknown - at) / wald, 1.0, 0.02) << p;
    EXPECT_FALSE(found.better);
  }
}

TEST(Profile, IsOpenWhereTheDataSeeNothing) {
  const Sensors made(2);  // about the beam's own axis
  DataSet data(made.experiment);
  data.set_noise(white_noise(noise), white_noise(1.0));
  Simulator simulator(made.experiment, {0.02, 1.0 / 240}, 1);
  Evaluator evaluator(simulator, data);
  const FitSummary best = fit(evaluator, made.model, {{0}});
  const Profile found = profile(evaluator, best, 1, {{0}});
  EXPECT_TRUE(found.low.at_bound);
  EXPECT_TRUE(found.high.at_bound);
}

// Modulus and density that do nearly the same in a unit a million times as large, and a damping
// that moves nothing.
TEST(Covariance, IsThatOfWhatTheDataShow) {
  FitSummary fit;
  fit.hypothesis = baseline();
  for (FreeParameter& free : fit.hypothesis.free) free.prior = 0.0;
  ASSERT_EQ(fit.hypothesis.size(), 3);
  const double unit = 1.0e6;
  fit.jacobian.setZero(2, 3);
  fit.jacobian.row(0) << 1.0, unit, 0.0;
  fit.jacobian.row(1) << 0.0, 1.0e-3 * unit, 0.0;
  const Covariance found = covariance_of(fit);
  EXPECT_EQ(found.open, std::vector<int>{2});
  EXPECT_TRUE(std::isinf(found.condition));
  // Of the inverse of J: [1, -1000; 0, 1000] by units.
  EXPECT_NEAR(found.matrix(0, 0), 1.0 + 1.0e6, 10.0);
  EXPECT_NEAR(found.matrix(1, 1) * unit * unit, 1.0e6, 10.0);
  EXPECT_EQ(found.matrix.col(2).norm(), 0.0);
  // A prior shows it.
  fit.hypothesis.free[2].prior = 0.5;
  EXPECT_NEAR(covariance_of(fit).matrix(2, 2), 0.25, 1.0e-12);
}

TEST(Hypothesis, WithoutAnEffectKeepsTheOthersNumbers) {
  Hypothesis model = baseline();
  model.set_value(2, 3.0);
  const Hypothesis fewer = model.without(1);
  ASSERT_EQ(fewer.size(), 2);
  EXPECT_EQ(fewer.value(0), model.value(0));
  EXPECT_EQ(fewer.value(1), 3.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
