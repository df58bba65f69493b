#include "engine/world/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/scene_reader.h"
#include "engine/world/settings.h"

namespace pedicel::world {
namespace {

double number(const Variation& variation, std::uint64_t seed) {
  return *to_number(variation.draw(seed).front().second);
}

TEST(Variation, ALognormalNumberHasTheMeanAndDeviationAskedFor) {
  const Variation variation =
      Variation::parse("k: {distribution: lognormal, mean: 2.0e7, deviation: 6.0e6}", "vary");
  constexpr int count = 20000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = number(variation, static_cast<std::uint64_t>(i));
    EXPECT_GT(value, 0.0);
    sum += value, squares += value * value;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean / 2.0e7, 1.0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean) / 6.0e6, 1.0, 0.04);
}

TEST(Variation, StaysWithinItsBounds) {
  const Variation variation = Variation::parse(
      "k: {distribution: normal, mean: 0, deviation: 1, low: -0.5, high: 0.25}", "vary");
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    EXPECT_GE(number(variation, seed), -0.5);
    EXPECT_LE(number(variation, seed), 0.25);
  }
}

// A scene is drawn from before its faults are told: an empty choice divided by zero there.
TEST(Variation, AnEmptyChoiceOfASceneIsToldAndNotDrawnFrom) {
  Diagnostics diagnostics;
  const auto scene = parse_scene(
      "format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\nduration: 1\n"
      "vary: {detach.stretch: {distribution: choice, values: []}}\n",
      "try.scene.yaml", diagnostics);
  EXPECT_FALSE(scene && !diagnostics.has_errors());
  EXPECT_THAT(diagnostics.text(), testing::HasSubstr("values: is empty"));
}

TEST(Variation, KeysAreDrawnInTheirOrder) {
  const std::string a = "a: {distribution: uniform, low: 0, high: 1}\n",
                    b = "b: {distribution: choice, values: [red, green]}\n";
  const auto both = Variation::parse(a + b, "vary").draw(5);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].first, "a");
  EXPECT_TRUE(both[1].second == "red" || both[1].second == "green");
  // What comes later does not change what comes first.
  EXPECT_EQ(Variation::parse(a, "vary").draw(5)[0], both[0]);
}

TEST(Variation, FaultsHaveTheirPlaces) {
  try {
    Variation::parse("a: {distribution: uniform, low: 2, high: 1}\nb: {distribution: choice}\n",
                     "v");
    FAIL();
  } catch (const InvalidFile& fault) {
    ASSERT_EQ(fault.all().size(), 2u) << fault.what();
    EXPECT_EQ(fault.all()[0].where.line, 1);
    EXPECT_EQ(fault.all()[1].where.line, 2);
  }
}

}  // namespace
}  // namespace pedicel::world
