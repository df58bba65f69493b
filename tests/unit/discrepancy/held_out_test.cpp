// Models on held-out trials, as linear predictions whose answers are known.
#include "plugins/discrepancy/test/held_out.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pedicel::discrepancy {
namespace {

constexpr int samples = 400;

// A change of `size` noise units in all along one of two orthogonal shapes.
Eigen::VectorXd shape(int which, double size) {
  Eigen::VectorXd d(samples);
  for (int i = 0; i < samples; ++i) d[i] = std::cos((which + 1) * 2.0 * M_PI * i / samples);
  return size * d.normalized();
}

// Noise of unit variance with nothing along either shape.
Eigen::VectorXd noise() {
  Eigen::VectorXd n(samples);
  for (int i = 0; i < samples; ++i) n[i] = i % 2 == 0 ? 1.0 : -1.0;
  return n;
}

// A model that knows its one unknown to `deviation`, and whose prediction moves along shape 1.
HeldOutModel model(const Eigen::VectorXd& residual, double deviation) {
  return {residual, shape(1, 10.0), Eigen::MatrixXd::Zero(1, 1),
          Eigen::VectorXd::Constant(1, 1.0 / (deviation * deviation))};
}

TEST(HeldOut, GainsHalfTheSquareOfWhatItExplains) {
  const HeldOutModel base = model(noise() + shape(0, 8.0), 1e-3);
  const HeldOutModel right = model(noise(), 1e-3), wrong = model(noise() + shape(0, 16.0), 1e-3);
  const std::array models{right, wrong};
  const std::vector<HeldOut> found = held_out(base, models, samples, 1.0);
  EXPECT_NEAR(found[0].gain, 32.0, 1e-3);
  EXPECT_NEAR(found[0].expected, 32.0, 1e-3);
  EXPECT_TRUE(found[0].carries_over({}));
  EXPECT_NEAR(found[1].gain, -96.0, 1e-3);
  EXPECT_FALSE(found[1].carries_over({}));
}

// Off by five deviations of noise along what the unknown moves. Known to a hundredth of that, it
// costs the whole of (50^2 / 2); where the fit left it open to 10, next to nothing, but for what an
// open unknown is less sure of: ln(deviation * length) = ln 100.
TEST(HeldOut, AValleyOfTheFitNeitherHelpsNorHarms) {
  const Eigen::VectorXd off = noise() + shape(1, 50.0);
  const auto gain = [&](double deviation) {
    const std::array models{model(off, deviation)};
    return held_out(model(noise(), 1e-3), models, samples, 1.0).front().gain;
  };
  EXPECT_NEAR(gain(1e-3), -1250.0, 1.0);
  // 50^2 / 2 / (1 + 100^2), and the logarithm.
  EXPECT_NEAR(gain(10.0), -1250.0 / 10001.0 - 0.5 * std::log(10001.0), 1e-2);
}

// Noise of unit variance alone is 1; 40 noise units in all along what no unknown moves are 40^2
// more over all samples; along an unknown that the fit left open to ten deviations next to nothing.
TEST(HeldOut, ExcessLeavesOutWhatTheUnknownsMayTake) {
  const auto excess = [](const HeldOutModel& model) {
    return held_out_excess(model, samples, 1.0);
  };
  EXPECT_NEAR(excess(model(noise(), 1e-3)), 1.0, 1e-9);
  EXPECT_NEAR(excess(model(noise() + shape(0, 40.0), 1e-3)), 1.0 + 1600.0 / samples, 1e-6);
  EXPECT_NEAR(excess(model(noise() + shape(1, 40.0), 10.0)), 1.0 + 1600.0 / samples / 1e4, 1e-6);
  EXPECT_NEAR(held_out_excess(model(2.0 * noise(), 1e-3), samples, 4.0), 1.0, 1e-9);
}

// Both miss the same by far more than noise: what they differ in counts in units of that.
TEST(HeldOut, WhatNoModelExplainsIsNoise) {
  const Eigen::VectorXd missed = 7.0 * noise();
  const HeldOutModel base = model(missed + shape(0, 28.0), 1e-3);
  const std::array models{model(missed, 1e-3)};
  EXPECT_NEAR(held_out(base, models, samples, 1.0).front().gain, 0.5 * 28.0 * 28.0 / 49.0, 0.1);
}

}  // namespace
}  // namespace pedicel::discrepancy
