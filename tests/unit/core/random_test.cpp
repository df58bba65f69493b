#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <array>

namespace pedicel {
namespace {

// The first outputs of SplitMix64 from seed 1234567, as published with the generator (Steele, Lea,
// Flood 2014; reference implementation by Vigna).
TEST(Random, IsSplitMix64) {
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ull);
  EXPECT_EQ(random.next(), 3203168211198807973ull);
  EXPECT_EQ(random.next(), 9817491932198370423ull);
}

TEST(Random, SameSeedSameNumbers) {
  Random a(42), b(42), c(43);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(Random(42).next(), c.next());
}

// Mean (a + b) / 2 and variance (b - a)^2 / 12; four standard errors of 1e5 draws.
TEST(Random, UniformIsUniform) {
  Random random(1);
  double sum = 0.0, square = 0.0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double value = random.uniform(-1.0, 3.0);
    ASSERT_GE(value, -1.0);
    ASSERT_LT(value, 3.0);
    sum += value, square += (value - 1.0) * (value - 1.0);
  }
  EXPECT_NEAR(sum / n, 1.0, 0.015);
  EXPECT_NEAR(square / n, 16.0 / 12.0, 0.02);
}

TEST(Random, IntegerReachesBothEnds) {
  Random random(2);
  std::array<int, 5> seen{};
  for (int i = 0; i < 5000; ++i) {
    const int value = random.integer(-2, 2);
    ASSERT_GE(value, -2);
    ASSERT_LE(value, 2);
    ++seen[static_cast<std::size_t>(value + 2)];
  }
  for (const int count : seen) EXPECT_NEAR(count, 1000, 120);
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  Random random(3);
  double sum = 0.0, square = 0.0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double value = random.normal();
    ASSERT_TRUE(std::isfinite(value));
    sum += value, square += value * value;
  }
  EXPECT_NEAR(sum / n, 0.0, 0.013);
  EXPECT_NEAR(square / n, 1.0, 0.02);
}

}  // namespace
}  // namespace pedicel
