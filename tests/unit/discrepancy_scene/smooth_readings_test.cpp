#include "plugins/discrepancy/scene/smooth_readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 2.0e-5;  // rad

// A move of minimum jerk from 0.3 s to 1.5 s, read at 250 Hz.
double move(double t) {
  const double s = std::clamp((t - 0.3) / 1.2, 0.0, 1.0);
  return 0.5 * s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

Samples readings(double deviation) {
  Samples samples;
  Random random(7);
  samples.value.resize(501, 1);
  for (int i = 0; i <= 500; ++i) {
    samples.time.push_back(0.004 * i);
    samples.value(i, 0) = move(0.004 * i) + deviation * random.normal();
  }
  return samples;
}

double rms_error(const JointPath& path) {
  double sum = 0.0;
  for (int i = 0; i <= 1000; ++i) sum += std::pow(path.at(0.002 * i).q[0] - move(0.002 * i), 2);
  return std::sqrt(sum / 1001.0);
}

TEST(SmoothReadings, LeavesLessThanHalfOfTheNoise) {
  for (const double stated : {noise, 0.0}) {
    const JointPath path = smooth_readings(readings(noise), stated);
    EXPECT_LT(rms_error(path), 0.5 * noise) << stated;
    EXPECT_NEAR(path.scatter()[0], noise, 0.1 * noise) << stated;
  }
}

TEST(SmoothReadings, AccelerationsAreThoseOfTheMotion) {
  const JointPath path = smooth_readings(readings(noise), noise);
  double worst = 0.0;
  for (double t = 0.1; t < 1.9; t += 0.01) {
    const double e = 1.0e-3;
    const double expected = (move(t + e) - 2.0 * move(t) + move(t - e)) / (e * e);
    worst = std::max(worst, std::abs(path.at(t).qdd[0] - expected));
  }
  // Accelerations are up to 2 rad/s2, and their kinks at the ends of the move are rounded.
  EXPECT_LT(worst, 0.15);
}

TEST(SmoothReadings, DerivativesBelongToThePositions) {
  const JointPath path = smooth_readings(readings(noise), noise);
  for (const double t : {0.5003, 0.9001, 1.2}) {
    const double e = 1.0e-4;
    const double before = path.at(t - e).q[0], here = path.at(t).q[0], after = path.at(t + e).q[0];
    EXPECT_NEAR(path.at(t).qd[0], (after - before) / (2 * e), 1e-6);
    EXPECT_NEAR(path.at(t).qdd[0], (after - 2 * here + before) / (e * e), 1e-3);
  }
}

TEST(SmoothReadings, GapsAreBridgedAndEndsStandStill) {
  Samples samples = readings(noise);
  for (int i = 200; i < 215; ++i) samples.value(i, 0) = std::nan("");
  const JointPath path = smooth_readings(samples, noise);
  EXPECT_NEAR(path.at(0.828).q[0], move(0.828), 1e-4);
  EXPECT_EQ(path.at(-1.0).q[0], path.at(0.0).q[0]);
  EXPECT_EQ(path.at(5.0).q[0], path.at(2.0).q[0]);
  EXPECT_EQ(path.at(5.0).qd[0], 0.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
