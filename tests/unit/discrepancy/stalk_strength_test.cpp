// Laws of breaking from when fruits came off, on loads that are known: ramps of force, moment and
// torsion in fixed proportions, one for each stalk.
#include "plugins/discrepancy/select/stalk_strength.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"

namespace pedicel::discrepancy {
namespace {

constexpr double step = 0.01, window = 0.02, duration = 3.0;  // s

/// Rises by `rate` (N/s, N m/s) from 0; stays on where no strength is given.
StalkLoads ramp(double force_rate, double moment_rate, double came_off) {
  StalkLoads stalk;
  stalk.trial = "pull";
  stalk.fruit = "fruit";
  stalk.came_off = came_off;
  for (double t = 0.0; t <= std::min(duration, came_off) + 1e-9; t += step) {
    stalk.time.push_back(t);
    stalk.load.push_back({0.0, 0.0, force_rate * t, moment_rate * t, 0.0});
  }
  return stalk;
}

/// Where (N/force)^2 + (M/moment)^2 reaches the square of a strength.
double break_time(double force_rate, double moment_rate, double force, double moment,
                  double strength) {
  return strength / std::hypot(force_rate / force, moment_rate / moment);
}

std::vector<StalkLoads> pulls(double force, double moment, double scatter, int count) {
  Random random(5);
  std::vector<StalkLoads> stalks;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.5 * M_PI * i / (count - 1);
    const double n = 4.0 * std::cos(angle) + 0.1, m = 0.02 * std::sin(angle) + 0.0005;
    const double strength = std::exp(scatter * random.normal());
    stalks.push_back(ramp(n, m, break_time(n, m, force, moment, strength)));
  }
  return stalks;
}

std::vector<BreakLaw> thresholds(double force, std::size_t count) {
  BreakLaw law;
  law.scale[stalk_force] = force;
  return std::vector<BreakLaw>(count, law);
}

constexpr double never = std::numeric_limits<double>::infinity();

TEST(StalkStrength, FindsForceAndMomentOfTheLawThatBreaksStalks) {
  const StalkStrength found =
      judge_strength(pulls(3.0, 0.02, 0.05, 14), thresholds(3.0, 14), window, {});
  EXPECT_EQ(found.broken, 14);
  EXPECT_TRUE(found.needs_law()) << found.summary();
  ASSERT_TRUE(found.law);
  const auto near = [&](StalkLoad load, double truth) {
    return std::abs(std::log(found.law->law.scale[load] / truth)) < 3.0 * found.law->error[load];
  };
  EXPECT_TRUE(near(stalk_force, 3.0)) << found.law->law.scale[stalk_force];
  EXPECT_TRUE(near(stalk_moment, 0.02)) << found.law->law.scale[stalk_moment];
  EXPECT_TRUE(std::isinf(found.law->law.scale[stalk_torsion]));
  EXPECT_NEAR(found.law->law.scale[stalk_force], 3.0, 0.25);
  EXPECT_NEAR(found.law->law.scale[stalk_moment], 0.02, 0.002);
  EXPECT_LT(found.law->law.scatter, 0.12);
}

// Strengths that scatter, about thresholds that are right or a little off, ask for no law.
TEST(StalkStrength, ThresholdsThatHoldAreLeftAlone) {
  for (const double scatter : {0.0, 0.05, 0.2})
    for (const double given : {2.8, 3.0, 3.2}) {
      const StalkStrength found =
          judge_strength(pulls(3.0, never, scatter, 16), thresholds(given, 16), window, {});
      EXPECT_FALSE(found.needs_law()) << scatter << ", " << given << ": " << found.summary();
    }
}

TEST(StalkStrength, FruitsThatNeverComeOffByTheFileNeedALaw) {
  const StalkStrength found =
      judge_strength(pulls(3.0, never, 0.05, 8), std::vector<BreakLaw>(8), window, {});
  EXPECT_TRUE(found.needs_law()) << found.summary();
  EXPECT_NEAR(found.law->law.scale[stalk_force], 3.0, 0.2);
  EXPECT_THAT(found.sentence(), testing::HasSubstr("by the plant file's thresholds none does"));
}

TEST(StalkStrength, FewBreaksMakeNoLaw) {
  const StalkStrength found =
      judge_strength(pulls(3.0, 0.02, 0.0, 3), thresholds(1.0, 3), window, {});
  EXPECT_FALSE(found.law);
  EXPECT_FALSE(found.needs_law());
  EXPECT_THAT(found.summary(), testing::HasSubstr("too few for a law: 4 are needed"));
}

// Stalks that bore their trials speak, too: without them a weak law would do as well.
TEST(StalkStrength, StalksThatHeldCount) {
  std::vector<StalkLoads> stalks = pulls(3.0, never, 0.05, 6);
  const StalkStrength alone = judge_strength(stalks, thresholds(1.5, 6), window, {});
  for (int i = 0; i < 6; ++i) stalks.push_back(ramp(0.9, 0.0, never));  // up to 2.7 N
  const StalkStrength both = judge_strength(stalks, thresholds(1.5, 12), window, {});
  EXPECT_GT(both.evidence, alone.evidence + 6.0);
}

TEST(StalkStrength, StalksThatBoreNothingMakeNoLaw) {
  std::vector<StalkLoads> stalks;
  for (int i = 0; i < 5; ++i) stalks.push_back(ramp(0.0, 0.0, 1.0));
  const StalkStrength found = judge_strength(stalks, thresholds(3.0, 5), window, {});
  EXPECT_FALSE(found.law);
  EXPECT_FALSE(found.needs_law());
}

// What counts is the largest load until then, not that of the moment.
TEST(StalkStrength, AStalkThatBoreMoreBeforeIsNoBreakOfTheLaw) {
  StalkLoads stalk = ramp(4.0, 0.0, 1.0);
  BreakLaw law;
  law.exponent = 2.0;
  law.scale[stalk_force] = 2.0;
  EXPECT_DOUBLE_EQ(law.most(stalk, 0.5), 1.0);
  for (std::size_t i = 60; i < stalk.load.size(); ++i) stalk.load[i][stalk_force] = 0.5;
  EXPECT_NEAR(law.most(stalk, 1.0), 0.59 * 4.0 / 2.0, 1e-12);
}

TEST(StalkStrength, ReadsTheFilesThresholdsAndItsLaw) {
  plant::PlantFile plant;
  plant::PlantFruit fruit;
  fruit.place.curve = "stalk";
  fruit.detach.stretch = 0.2;
  fruit.detach.force = 3.0;
  BreakLaw law = break_law_of(plant, fruit);
  EXPECT_DOUBLE_EQ(law.load({0.1, 9.0, 2.4, 9.0, 9.0}), 0.8);  // the larger ratio
  plant::Effect effect;
  effect.name = "detachment_law";
  effect.numbers = {{"force", {5.0}}, {"moment", {0.1}}};
  plant.effects = {effect};
  law = break_law_of(plant, fruit);
  EXPECT_DOUBLE_EQ(law.load({9.0, 9.0, 3.0, 0.08, 9.0}), 1.0);
  plant.effects.front().place = plant::CurvePlace{"other", 0.0, {}};
  EXPECT_DOUBLE_EQ(break_law_of(plant, fruit).scale[stalk_force], 3.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
