#include "engine/core/ring_down.h"

#include <gtest/gtest.h>

namespace pedicel {
namespace {

// 10 s of exp(-zeta w t) cos(w_d t + 1) at 240 Hz, and a second mode at 6.27 times the frequency.
std::vector<double> signal(double frequency, double zeta, double second_mode) {
  const double damped = 2.0 * M_PI * frequency;
  const double decay = damped * zeta / std::sqrt(1.0 - zeta * zeta);
  std::vector<double> samples;
  for (int i = 0; i < 2400; ++i) {
    const double t = i / 240.0;
    samples.push_back(std::exp(-decay * t) * std::cos(damped * t + 1.0) +
                      second_mode * std::cos(6.27 * damped * t));
  }
  return samples;
}

// What leaks through a Hann window (side lobes 1 / (k (k^2 - 1)) of the main one) at k bins, over
// the phase 2 pi n that n periods turn through: the mirror frequency is k = 2 n bins away, so the
// relative error of the frequency and that of the damping ratio are below 4 / (2 pi n (2 n)^3), n =
// 5 x the frequency in Hz; the last factor 4: two amplitudes, each with its side lobe of at most
// twice that size for a damped signal.
double bound(double frequency) {
  const double periods = 5.0 * frequency;
  return 4.0 / (2.0 * M_PI * periods * std::pow(2.0 * periods, 3));
}

TEST(RingDown, FindsFrequencyAndDamping) {
  for (const double frequency : {1.10599, 2.31})
    for (const double zeta : {0.0, 1.0e-4, 0.0145, 0.058, -0.01}) {
      const auto ring = ring_down(signal(frequency, zeta, 0.0), 1.0 / 240.0);
      ASSERT_TRUE(ring);
      EXPECT_NEAR(ring->frequency / frequency, 1.0, bound(frequency)) << zeta;
      EXPECT_NEAR(ring->damping_ratio, zeta, bound(frequency)) << frequency;
    }
}

TEST(RingDown, DoesNotMindAHigherMode) {
  const auto ring = ring_down(signal(1.10599, 0.01, 0.02), 1.0 / 240.0);
  ASSERT_TRUE(ring);
  EXPECT_NEAR(ring->frequency / 1.10599, 1.0, bound(1.10599));
  EXPECT_NEAR(ring->damping_ratio, 0.01, bound(1.10599));
}

TEST(RingDown, SaysNothingOfASignalThatDoesNotOscillate) {
  EXPECT_FALSE(ring_down({}, 0.01));
  EXPECT_FALSE(ring_down(std::vector<double>(100, 1.0), 0.01));
  EXPECT_FALSE(ring_down(signal(0.3, 0.0, 0.0), 1.0 / 240.0)) << "6 crossings";
}

}  // namespace
}  // namespace pedicel
