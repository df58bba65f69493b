// Noise models. Exact covariances must give the weights that made them (Yule-Walker: of a process
// x_t = a x_(t-1) + b x_(t-2) + e the correlations are r1 = a / (1 - b) and r_k = a r_(k-1) +
// b r_(k-2)); drawn series must give them within the scatter of the estimate.
#include "plugins/discrepancy/simulate/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/discrepancy/coloured_noise.h"

namespace pedicel::discrepancy {
namespace {

using testing::coloured;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

TEST(Autoregressive, GivesTheWeightsThatMadeTheCovariances) {
  const double a = 0.9, b = -0.3, variance = 4.0e-8;
  const double r1 = a / (1.0 - b), r2 = a * r1 + b, r3 = a * r2 + b * r1;
  const double covariance[] = {variance, variance * r1, variance * r2, variance * r3};
  const Noise noise = autoregressive(covariance, 1000.0);
  ASSERT_EQ(noise.order(), 2);  // the third weight would be 0 and cost ln(1000)
  EXPECT_NEAR(noise.std, std::sqrt(variance), 1e-18);
  EXPECT_NEAR(noise.weights[0][0], r1, 1e-12);
  EXPECT_NEAR(noise.weights[1][0], a, 1e-12);
  EXPECT_NEAR(noise.weights[1][1], b, 1e-12);
  ASSERT_EQ(noise.innovation.size(), 3u);
  EXPECT_NEAR(noise.innovation[0], noise.std, 1e-18);
  EXPECT_NEAR(noise.innovation[1], noise.std * std::sqrt(1.0 - r1 * r1), 1e-15);
  EXPECT_NEAR(noise.innovation[2], noise.std * std::sqrt(1.0 - a * r1 - b * r2), 1e-15);
}

// A correlation r shortens the score n ln(variance) by -n ln(1 - r^2), and a weight costs ln n:
// with n = 1000 it pays from r = sqrt(1 - exp(-ln(n) / n)) = 0.0830 on.
TEST(Autoregressive, TakesAWeightOnlyWhereItPays) {
  const double limit = std::sqrt(1.0 - std::exp(-std::log(1000.0) / 1000.0));
  const double below[] = {1.0, 0.98 * limit}, above[] = {1.0, 1.02 * limit};
  EXPECT_EQ(autoregressive(below, 1000.0).order(), 0);
  EXPECT_EQ(autoregressive(above, 1000.0).order(), 1);
  EXPECT_EQ(autoregressive(below, 2000.0).order(), 1);
}

std::vector<Series> channels(std::uint64_t seed, double correlation, double scale, int count = 12,
                             int size = 2000) {
  Random random(seed);
  std::vector<Series> made;
  for (int c = 0; c < count; ++c) made.push_back(scale * coloured(random, size, correlation));
  return made;
}

// N = 24000 samples of a correlation r = 0.8. The level is the mean of (x_i - x_j)^2 / 2 far apart:
// the squares scatter by 2 (1 + r^2) / (1 - r^2) / N, the products by half of that over the share
// 0.6 of pairs that a window has, 3.7 (1 + r^2) / (1 - r^2) / N = 0.0265^2 together; the standard
// deviation by half of it. The correlation is 1 - 0.2 / level times what neighbours differ by,
// which is known to 1 %: 0.2 x 0.028 = 0.0056. Leaving out the strongest windows lowers the level
// by some 2 %. Bounds: five deviations and that.
TEST(EstimatedNoise, FindsSizeAndCorrelationOfADrawnSeries) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Noise noise = estimate_noise(channels(seed, 0.8, 3e-4), 0.0);
    EXPECT_NEAR(noise.std / 3e-4, 1.0, 0.066 + 0.01) << seed;
    EXPECT_NEAR(noise.correlation(), 0.8, 0.028 + 0.004) << seed;
    EXPECT_NEAR(noise.innovation[1] / 3e-4, 0.6, 0.04) << seed;
  }
}

TEST(EstimatedNoise, OfWhiteNoiseIsWhite) {
  const Noise noise = estimate_noise(channels(4, 0.0, 1.0), 0.0);
  EXPECT_EQ(noise.order(), 0);
  EXPECT_NEAR(noise.std, 1.0, 0.03);  // sqrt(3.7 / 24000) / 2 = 0.006, five times
}

// A drift of s = 0.004 deviations a sample adds (k s)^2 / 2 at lag k: between 0.5 and 2 % at the
// lags 25 to 50 of the level. Over the record it goes through 8 deviations, so that the series
// about its mean scatters by 8 / sqrt(12) = 2.3 more.
TEST(EstimatedNoise, IsNotMovedByAConstantOrASlowDrift) {
  std::vector<Series> all = channels(5, 0.0, 1.0);
  for (Series& series : all)
    for (int i = 0; i < series.size(); ++i) series[i] += 1000.0 + 0.004 * i;
  const Series& first = all.front();
  EXPECT_GT((first.array() - first.mean()).square().mean(), 5.0);
  const Noise noise = estimate_noise(all, 0.0);
  EXPECT_NEAR(noise.std, 1.0, 0.04);
  EXPECT_NEAR(noise.correlation(), 0.0, 0.04);
}

TEST(EstimatedNoise, IsTakenFromWhatStandsStill) {
  std::vector<Series> all = channels(6, 0.5, 1.0);
  for (Series& series : all)  // 60 % of each record moves
    for (int i = 800; i < series.size(); ++i) series[i] += 20.0 * std::sin(0.2 * i);
  const Noise noise = estimate_noise(all, 0.0);
  EXPECT_NEAR(noise.std, 1.0, 0.06);
  EXPECT_NEAR(noise.correlation(), 0.5, 0.06);
}

TEST(EstimatedNoise, WithoutAWindowIsWhatIsStated) {
  const std::vector<Series> none, stuck{Series::Constant(500, 0.3)}, tiny{Series::Random(12)};
  for (const auto* channels : {&none, &stuck, &tiny}) {
    EXPECT_EQ(estimate_noise(*channels, 2e-4).std, 2e-4);
    EXPECT_EQ(estimate_noise(*channels, 0.0).std, 1.0);
    EXPECT_EQ(estimate_noise(*channels, 2e-4).order(), 0);
  }
}

TEST(ChosenNoise, StaysWithinWhatIsStated) {
  const std::vector<Series> all = channels(7, 0.8, 1.0);
  const NoiseRule rule;
  EXPECT_NEAR(choose_noise(all, 0.0, rule).std, 1.0, 0.08);
  // Half of the estimate, and somewhat more than it: what is stated counts.
  EXPECT_DOUBLE_EQ(choose_noise(all, 0.5, rule).std, 0.5);
  EXPECT_DOUBLE_EQ(choose_noise(all, 1.1, rule).std, 1.1);
}

// Channels that scatter three times less than is stated stand still. Their own colour is white, and
// nothing in them says that the noise of the others remembers anything.
TEST(ChosenNoise, OfStillWhiteChannelsDoesNotRemember) {
  const std::vector<Series> still = channels(8, 0.0, 1.0);
  for (const NoiseRule rule : {NoiseRule{1.0, true}, NoiseRule{0.5, false}}) {
    const Noise noise = choose_noise(still, 3.0, rule);
    EXPECT_DOUBLE_EQ(noise.std, 3.0);
    EXPECT_NEAR(noise.correlation(), 0.0, 0.05);
    EXPECT_NEAR(noise.innovation.back(), 3.0, 0.05);
  }
}

TEST(ChosenNoise, BelowItsLeastShareIsWhiteWhereColourDoesNotCount) {
  const std::vector<Series> still = channels(9, 0.8, 1.0);
  EXPECT_EQ(choose_noise(still, 3.0, {0.5, false}).order(), 0);
  EXPECT_DOUBLE_EQ(choose_noise(still, 3.0, {0.5, false}).std, 3.0);
  EXPECT_NEAR(choose_noise(still, 3.0, {1.0, true}).correlation(), 0.8, 0.04);
}

// The mean square of 20000 white numbers of unit variance scatters by sqrt(2 / 20000) = 0.01, their
// lag-one correlation by 1 / sqrt(20000) = 0.007.
TEST(Whitening, GivesUnitInnovationsWithoutMemory) {
  Random random(10);
  const Series noise = 2e-4 * coloured(random, 20000, 0.9);
  const double covariance[] = {4e-8, 0.9 * 4e-8};
  const Eigen::VectorXd white = whiten(noise, autoregressive(covariance, 1e6));
  EXPECT_NEAR(testing::power(white), 1.0, 0.05);
  EXPECT_NEAR(testing::lag_one(white), 0.0, 0.035);
  EXPECT_GT(testing::lag_one(noise), 0.85);
}

TEST(Whitening, StartsAfreshAfterAGap) {
  const double a = 0.9, b = -0.3, r1 = a / (1.0 - b), r2 = a * r1 + b;
  const double covariance[] = {1.0, r1, r2};
  const Noise noise = autoregressive(covariance, 1e6);
  Series x(7);
  x << 1.0, 2.0, 3.0, no_number, 4.0, 5.0, 6.0;
  const Eigen::VectorXd white = whiten(x, noise);
  const double one = std::sqrt(1.0 - r1 * r1), two = std::sqrt(1.0 - a * r1 - b * r2);
  EXPECT_NEAR(white[0], 1.0, 1e-12);
  EXPECT_NEAR(white[1], (2.0 - r1) / one, 1e-12);
  EXPECT_NEAR(white[2], (3.0 - a * 2.0 - b) / two, 1e-12);
  EXPECT_TRUE(std::isnan(white[3]));
  EXPECT_NEAR(white[4], 4.0, 1e-12);
  EXPECT_NEAR(white[5], (5.0 - r1 * 4.0) / one, 1e-12);
  EXPECT_NEAR(white[6], (6.0 - a * 5.0 - b * 4.0) / two, 1e-12);
}

}  // namespace
}  // namespace pedicel::discrepancy
