// Directed statistics on residuals that are drawn: standard normal where nothing but noise is left,
// and no alarm; what is laid along a direction must raise one.
#include "plugins/discrepancy/test/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "tests/unit/discrepancy/made_diagnosis.h"

namespace pedicel::discrepancy {
namespace {

constexpr int samples = 200, count = 12;

Eigen::VectorXd drawn(Random& random, int size) {
  Eigen::VectorXd x(size);
  for (double& value : x) value = random.normal();
  return x;
}

// Neighbours have half of what they say in common.
std::vector<Direction> overlapping(std::uint64_t seed) {
  Random random(seed);
  std::vector<Direction> made;
  Eigen::VectorXd last = drawn(random, samples);
  for (int d = 0; d < count; ++d) {
    const Eigen::VectorXd next = drawn(random, samples);
    made.push_back({"cause_" + std::to_string(d), {}, last + next, {}});
    last = next;
  }
  return made;
}

// Over n = 200 draws the mean square of a standard normal number scatters by sqrt(2 / n) = 0.1 and
// its mean by 1 / sqrt(n) = 0.07; with twelve of them five times that is allowed. The level is 5 at
// least, which white noise exceeds along twelve directions once in 150 000 draws.
TEST(Directions, OfWhiteNoiseAreStandardNormalAndRaiseNoAlarm) {
  std::vector<Direction> directions = overlapping(1);
  Random random(2);
  const int draws = 200;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(count), square = mean;
  int alarms = 0;
  for (int i = 0; i < draws; ++i) {
    FitSummary base;
    base.residual = drawn(random, samples);
    alarms += judge(directions, base, {}, 3, {}).raised ? 1 : 0;
    for (int d = 0; d < count; ++d) {
      mean[d] += directions[d].statistic / draws;
      square[d] += std::pow(directions[d].statistic, 2) / draws;
    }
  }
  EXPECT_EQ(alarms, 0);
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.35);
  EXPECT_LT((square.array() - 1.0).abs().maxCoeff(), 0.5);
  EXPECT_NEAR(square.mean(), 1.0, 0.15);
}

TEST(Directions, ShowWhatIsLaidAlongThem) {
  std::vector<Direction> directions = overlapping(4);
  Random random(5);
  FitSummary base;
  base.residual = drawn(random, samples) - 9.0 * directions[7].change.normalized();
  const Alarm alarm = judge(directions, base, {}, 3, {});
  EXPECT_TRUE(alarm.raised);
  EXPECT_EQ(alarm.strongest, 7);
  EXPECT_NEAR(directions[7].statistic, -9.0, 4.0);  // a standard normal number on top
  EXPECT_DOUBLE_EQ(alarm.statistic, std::abs(directions[7].statistic));
  EXPECT_GE(alarm.level, 5.0);
}

TEST(Directions, DoNotBlameWhatOurOwnErrorMayBe) {
  std::vector<Direction> directions = overlapping(4);
  Random random(5);
  const Eigen::VectorXd along = directions[7].change.normalized();
  FitSummary base;
  base.residual = drawn(random, samples) - 9.0 * along;
  EXPECT_FALSE(judge(directions, base, 8.0 * along, 3, {}).raised);
  EXPECT_NEAR(directions[7].systematic, 8.0, 1e-9);
}

TEST(Directions, WithoutLengthSayNothing) {
  std::vector<Direction> directions = overlapping(6);
  directions.resize(1);
  directions[0].change.setZero();
  FitSummary base;
  base.residual = Eigen::VectorXd::Constant(samples, 100.0);
  const Alarm alarm = judge(directions, base, {}, 3, {});
  EXPECT_FALSE(alarm.raised);
  EXPECT_EQ(directions[0].statistic, 0.0);
}

// Made 20 times as large, a segment of 0.6 of the stiffness would have a negative one: without
// bounds its logarithm is no number.
TEST(Hypotheses, StayWithinTheirBoundsWhenSizesGrow) {
  Hypothesis weak = hypothesis_of("weak_segment", "factor", 0.6, "1");
  weak.free[0].vanishes = Vanishes::at_one;
  weak.free[0].logarithmic = true;
  weak.free[0].low = 0.01, weak.free[0].high = 10.0;
  EXPECT_LT(weak.shrunk(20.0).value(0), 0.0);
  EXPECT_EQ(weak.shrunk(20.0).bounded().value(0), 0.01);
  EXPECT_TRUE(std::isfinite(weak.shrunk(20.0).bounded().unknowns()[0]));
  EXPECT_EQ(weak.bounded().value(0), 0.6);
}

// The response is about linear: a direction of length 4 at a mass of 20 g is seen at 5 from 25 g.
TEST(SmallestSeen, GoesWithTheSizeOfTheDirection) {
  Direction direction{"extra_mass", hypothesis_of("extra_mass", "mass", 0.02, "kg"), {}, {}};
  direction.start.free[0].vanishes = Vanishes::at_zero;
  direction.change = Eigen::VectorXd::Constant(4, 2.0);
  std::string parameter;
  EXPECT_NEAR(detectable_limit(direction, 5.0, parameter), 0.025, 1e-12);
  EXPECT_EQ(parameter, "mass");
  direction.start.free[0].vanishes =
      Vanishes::at_infinity;  // a spring: the softer the more it shows
  EXPECT_NEAR(detectable_limit(direction, 5.0, parameter), 0.016, 1e-12);
  direction.start.free[0].vanishes = Vanishes::at_nominal;  // a grip of 80 that is softer
  direction.start.free[0].nominal = 0.08;
  EXPECT_NEAR(detectable_limit(direction, 8.0, parameter), 0.08 * std::pow(0.25, 2.0), 1e-12);
  direction.change.setZero();
  EXPECT_TRUE(std::isinf(detectable_limit(direction, 5.0, parameter)));
}

// A wind along y alone: its component along x says nothing of its size.
TEST(SmallestSeen, OfAVectorIsALength) {
  Direction direction{"wind", hypothesis_of("wind", "velocity", 0.0, "m/s"), {}, {}};
  plant::Effect& wind = direction.start.effects[0];
  wind.numbers["velocity"] = {0.0, 0.6, 0.0};
  direction.start.free.push_back(direction.start.free[0]);
  direction.start.free[1].component = 1;
  for (FreeParameter& free : direction.start.free) free.vanishes = Vanishes::at_zero;
  direction.change = Eigen::VectorXd::Constant(4, 1.5);
  std::string parameter;
  EXPECT_NEAR(detectable_limit(direction, 1.0, parameter), 0.2, 1e-12);
}

// Beyond its threshold a law is seen or not; nothing is known of other thresholds.
TEST(SmallestSeen, OfALawWithAThresholdIsTheStart) {
  Direction direction{"yield", hypothesis_of("yield", "curvature", 0.7, "1/m"), {}, {}};
  direction.start.free[0].vanishes = Vanishes::at_infinity;
  direction.has_threshold = true;
  direction.change = Eigen::VectorXd::Constant(4, 3.0);
  std::string parameter;
  EXPECT_NEAR(detectable_limit(direction, 5.0, parameter), 0.7, 1e-12);
  EXPECT_TRUE(std::isinf(detectable_limit(direction, 7.0, parameter)));
}

}  // namespace
}  // namespace pedicel::discrepancy
