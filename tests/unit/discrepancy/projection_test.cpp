#include "plugins/discrepancy/test/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/random.h"
#include "plugins/discrepancy/test/oscillation.h"

namespace pedicel::discrepancy {
namespace {

// Stationary from its first sample.
Series coloured(Random& random, int n, double correlation) {
  Series e(n);
  e[0] = random.normal();
  for (int i = 1; i < n; ++i)
    e[i] = correlation * e[i - 1] + std::sqrt(1 - correlation * correlation) * random.normal();
  return e;
}

Noise model(double correlation) {
  const double c[] = {1.0, correlation};
  return autoregressive(c, 1e6);
}

// Over many seeds the estimate scatters by the error that it states: their ratio squared has mean
// 1 and, over 400 draws, a standard deviation of sqrt(2 / 400) = 0.07.
TEST(Projection, StatesItsErrorInColouredNoise) {
  const int n = 200;
  Eigen::MatrixXd x(n, 2);
  for (int i = 0; i < n; ++i) x.row(i) << 1.0, std::sin(0.05 * i);
  Random random(5);
  double first = 0.0, second = 0.0, bias = 0.0;
  const int draws = 400;
  for (int d = 0; d < draws; ++d) {
    Projection projection(2);
    const Series e = coloured(random, n, 0.8);
    projection.add(x * Eigen::Vector2d(0.3, -2.0) + e, x, model(0.8));
    Projection::Result result;
    ASSERT_TRUE(projection.solve(result));
    first += std::pow((result.value[0] - 0.3) / result.component(0).error, 2) / draws;
    second += std::pow((result.value[1] + 2.0) / result.component(1).error, 2) / draws;
    bias += (result.value[1] + 2.0) / result.component(1).error / draws;
  }
  EXPECT_NEAR(first, 1.0, 0.25);
  EXPECT_NEAR(second, 1.0, 0.25);
  EXPECT_NEAR(bias, 0.0, 0.2);
}

TEST(Projection, SaysWhenAnUnknownIsLeftOpen) {
  Eigen::MatrixXd x(50, 2);
  for (int i = 0; i < 50; ++i) x.row(i) << i, 2.0 * i;
  Projection projection(2);
  projection.add(Series::Ones(50), x, white_noise(1.0));
  Projection::Result result;
  EXPECT_FALSE(projection.solve(result));
}

TEST(Projection, GapsOnEitherSideAreLeftOut) {
  Series r = 3.0 * Series::Ones(40);
  Eigen::MatrixXd x = Eigen::MatrixXd::Ones(40, 1);
  r[7] = std::numeric_limits<double>::quiet_NaN();
  x(20, 0) = r[7];
  Projection projection(1);
  projection.add(r, x, model(0.5));
  Projection::Result result;
  ASSERT_TRUE(projection.solve(result));
  EXPECT_NEAR(result.value[0], 3.0, 1e-12);
  EXPECT_EQ(result.samples, 38);
  EXPECT_NEAR(result.explained, 1.0, 1e-12);
}

// A constant taken out beforehand leaves what fitting it along would find.
TEST(Projection, FreeConstantIsAsIfFittedAlong) {
  Random random(3);
  const int n = 60;
  Series r = coloured(random, n, 0.5);
  r[17] = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd both(n, 2), one(n, 1);
  for (int i = 0; i < n; ++i) both.row(i) << (one(i, 0) = 0.1 * i), 1.0;
  Projection along(2), beforehand(1);
  along.add(r, both, model(0.5));
  beforehand.add(r, one, model(0.5), Projection::Constant::free);
  Projection::Result a, b;
  ASSERT_TRUE(along.solve(a));
  ASSERT_TRUE(beforehand.solve(b));
  EXPECT_NEAR(a.value[0], b.value[0], 1e-12);
  EXPECT_NEAR(a.covariance(0, 0), b.covariance(0, 0), 1e-12);
}

// Closed forms for AR(1) with correlation a: autocorrelation a^k, and the mean of n samples has the
// variance (1 + 2 sum (1 - k/n) a^k) / n.
TEST(Projection, ColouredNoiseThroughWeights) {
  const double a = 0.7;
  const int n = 30;
  const auto rho = autocorrelation(model(a), 10);
  for (int k = 0; k <= 10; ++k) EXPECT_NEAR(rho[k], std::pow(a, k), 1e-9);
  double variance = 1.0;
  for (int k = 1; k < n; ++k) variance += 2.0 * (1.0 - static_cast<double>(k) / n) * std::pow(a, k);
  const Eigen::VectorXd mean = Eigen::VectorXd::Constant(n, 1.0 / n);
  EXPECT_NEAR(projected_std(mean, model(a)), std::sqrt(variance / n), 1e-9);
  EXPECT_NEAR(projected_std(mean, white_noise(2.0)), 2.0 / std::sqrt(n), 1e-12);
}

Series swing(double dt, int n, const std::vector<Oscillation>& modes, double constant) {
  OscillationFit fit;
  fit.constant = constant;
  fit.modes = modes;
  return values_of(fit, n, dt);
}

TEST(Oscillation, TwoModesAreFoundExactlyWithoutNoise) {
  const std::vector<Oscillation> truth{{0.03, 0.01, 12.0, 0.4}, {-0.002, 0.004, 70.0, 1.5}};
  const Series s = swing(0.01, 400, truth, 0.1);
  const auto first = main_oscillation(s, 0.01);
  ASSERT_TRUE(first);
  const auto one = fit_oscillations(s, 0.01, white_noise(1e-4), std::span(&*first, 1));
  ASSERT_TRUE(one);
  const auto second = higher_oscillation(s - values_of(*one, 400, 0.01), 0.01, one->modes[0].w);
  ASSERT_TRUE(second);
  const Oscillation start[] = {one->modes[0], *second};
  const auto both = fit_oscillations(s, 0.01, white_noise(1e-4), start);
  ASSERT_TRUE(both);
  for (int m = 0; m < 2; ++m) {
    EXPECT_NEAR(both->modes[m].w, truth[m].w, 1e-6 * truth[m].w);
    EXPECT_NEAR(both->modes[m].decay, truth[m].decay, 1e-5);
    EXPECT_NEAR(both->modes[m].amplitude(), truth[m].amplitude(), 1e-8);
  }
  EXPECT_NEAR(both->constant, 0.1, 1e-8);
}

// As above: over 200 seeds the mean square of error over stated error is 1 +- 0.1.
TEST(Oscillation, StatesItsErrors) {
  const std::vector<Oscillation> truth{{0.03, 0.0, 12.0, 0.4}};
  const Series clean = swing(0.02, 200, truth, 0.0);
  Random random(11);
  double f = 0.0, z = 0.0;
  const int draws = 200;
  Noise noise = model(0.5);
  noise.std *= 1e-3;
  for (double& s : noise.innovation) s *= 1e-3;
  for (int d = 0; d < draws; ++d) {
    const auto fit =
        fit_oscillations(clean + 1e-3 * coloured(random, 200, 0.5), 0.02, noise, truth);
    ASSERT_TRUE(fit);
    f += std::pow((fit->modes[0].frequency() - truth[0].frequency()) / fit->frequency_error(0), 2);
    z += std::pow(
        (fit->modes[0].damping_ratio() - truth[0].damping_ratio()) / fit->damping_error(0), 2);
  }
  EXPECT_NEAR(f / draws, 1.0, 0.35);
  EXPECT_NEAR(z / draws, 1.0, 0.35);
}

TEST(Oscillation, TooFewPeriodsAreRefused) {
  EXPECT_FALSE(main_oscillation(swing(0.02, 50, {{0.03, 0.0, 6.0, 0.1}}, 0.0), 0.02));
  EXPECT_FALSE(main_oscillation(Series::Ones(100), 0.02));
}

}  // namespace
}  // namespace pedicel::discrepancy
