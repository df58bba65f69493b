#include "plugins/discrepancy/force/missing_force.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "plugins/discrepancy/simulate/force_term.h"
#include "tests/unit/discrepancy/bent_stem.h"

namespace pedicel::discrepancy {

using namespace testing;

namespace {

void expect_found(const MissingForce& found, const std::string& kind, double place) {
  ASSERT_TRUE(found.found);
  EXPECT_EQ(found.kind, kind) << found.sentence();
  ASSERT_TRUE(found.place);
  EXPECT_EQ(found.place->curve, "stem");
  EXPECT_NEAR(found.place->at, place, 0.15);
  EXPECT_GT(found.place_error, 0.0);
  EXPECT_LT(found.place_error, 0.25);
  EXPECT_LT(std::abs(found.place->at - place), 3.0 * found.place_error) << found.sentence();
  EXPECT_NE(found.sentence().find(" ± "), std::string::npos) << found.sentence();
  EXPECT_TRUE(found.elsewhere.empty());
  // The law that made the data must leave noise alone: chi-square of about 3700 samples.
  EXPECT_GT(found.share, 0.9);
  EXPECT_NE(found.sentence().find("Do not extrapolate."), std::string::npos);
}

}  // namespace

// N, of the largest force that is told.
double size_said(const MissingForce& found) {
  double size = 0.0;
  EXPECT_EQ(std::sscanf(found.when.c_str(), "it reaches %lf N", &size), 1) << found.when;
  return size;
}

// Noise of the stated size is no force: nothing may be said.
TEST(MissingForce, NoiseAloneIsNothing) {
  BentStem bent;
  bent.measure({}, 1);
  const MissingForce found = bent.infer();
  EXPECT_FALSE(found.found) << found.sentence();
  EXPECT_TRUE(found.sentence().empty());
}

// Noise alone may be left of held-out trials, and by chance less than that.
TEST(MissingForce, RemovesNoMoreThanAllOfTheError) {
  MissingForce force;
  force.found = true;
  force.gain = 1.3;
  EXPECT_NE(force.sentence().find(" removes all of the error above the noise."), std::string::npos)
      << force.sentence();
  force.gain = 0.5;
  EXPECT_NE(force.sentence().find(" removes 50 % of the error above"), std::string::npos)
      << force.sentence();
}

// A string, slack at rest, a tenth as stiff as the stem.
TEST(MissingForce, String) {
  BentStem bent;
  double longest = 0.0;
  bent.measure({at(0.7,
                   [&longest](double, const Vec3& x, const Vec3&) -> Vec3 {
                     const Vec3 away = Vec3(-0.1, 0, 0.3) - x;
                     longest = std::max(longest, away.norm() - 0.105);
                     return 0.15 * std::max(0.0, away.norm() - 0.105) * away.normalized();
                   })},
               2);
  const MissingForce found = bent.infer();
  expect_found(found, "string", 0.7);
  EXPECT_TRUE(found.other_kinds.empty()) << found.sentence();
  // No marker is where it is tied: there it would hang slack. It was stretched by up to `longest`.
  EXPECT_NEAR(size_said(found), 0.15 * longest, 0.1 * 0.15 * longest);
}

TEST(MissingForce, Stop) {
  BentStem bent;
  bent.measure({soft_stop()}, 3);
  const MissingForce found = bent.infer();
  expect_found(found, "stop", 0.7);
  // It is a string to a far point as well.
  EXPECT_EQ(found.other_kinds, std::vector<std::string>{"string"});
  EXPECT_NE(found.sentence().find("Kind: stop or string, which"), std::string::npos);
}

// A stop thirty times as stiff as the stem: behind it the stem swings at another frequency. Where
// it acts and what it is can be told all the same.
TEST(MissingForce, StopFarStifferThanTheStem) {
  BentStem bent;
  bent.measure({at(0.7,
                   [](double, const Vec3& x, const Vec3&) -> Vec3 {
                     return 20.0 * std::max(0.0, -0.002 - x.x()) * Vec3::UnitX();
                   })},
               5);
  const MissingForce found = bent.infer();
  expect_found(found, "stop", 0.7);
  EXPECT_NEAR(found.terms.front().force.number("stiffness"), 20.0, 1.0) << found.sentence();
  // However large it is, no place is known better than to a node: 40 mm, uniformly, of the stem.
  EXPECT_GE(found.place_error, 0.04 / std::sqrt(12.0) / bent.stem_length());
}

// A stop, asked for about a plant that nobody believes in: ten times as stiff, six times as heavy.
TEST(MissingForce, IsTriedOnThePlantThatWasBelievedIn) {
  BentStem bent;
  bent.measure({soft_stop()}, 3);
  Hypothesis far = baseline();
  far.set_value(far.factor_on("youngs_modulus"), 9.0);
  far.set_value(far.factor_on("density"), 6.0);
  const MissingForce found = bent.infer(far, 0);
  expect_found(found, "stop", 0.7);
}

// Where known causes explain more than any force could, no law of one is looked for.
TEST(MissingForce, IsNotFollowedWhereItScoresTooLittle) {
  BentStem bent;
  bent.measure({soft_stop()}, 3);
  const MissingForce found = bent.infer(baseline(), 60, 1.0e6);
  EXPECT_FALSE(found.found) << found.sentence();
  EXPECT_TRUE(found.terms.empty());
  EXPECT_GT(found.simulations, 0);
}

// 0.6 mN at 1.7 Hz.
// A push that turned round between the trials explains the first and spoils the second.
TEST(MissingForce, IsNoFindingWhereItMakesHeldOutTrialsWorse) {
  BentStem bent, other;
  const auto push = [](double size) {
    return at(0.7, [size](double, const Vec3&, const Vec3&) -> Vec3 { return Vec3(0, size, 0); });
  };
  bent.measure({push(0.01)}, 9);
  other.measure({push(-0.01)}, 10);
  EXPECT_TRUE(bent.infer(baseline(), 60, 0.0, {0}, {1}).found);
  bent.experiment.trials[1] = other.experiment.trials[1];
  const MissingForce found = bent.infer(baseline(), 60, 0.0, {0}, {1});
  EXPECT_FALSE(found.found);
  EXPECT_NE(found.sentence().find("the held-out ones are worse"), std::string::npos)
      << found.sentence();
}

TEST(MissingForce, PeriodicPush) {
  BentStem bent;
  bent.measure({at(0.6,
                   [](double t, const Vec3&, const Vec3&) -> Vec3 {
                     return 6e-4 * std::sin(2 * M_PI * 1.7 * t) * Vec3(0.6, -0.8, 0);
                   })},
               4);
  const MissingForce found = bent.infer();
  expect_found(found, "periodic push", 0.6);
  ASSERT_FALSE(found.terms.empty());
  EXPECT_NEAR(found.terms.front().force.number("frequency"), 1.7, 0.02);
}

// Towards a point 5 cm aside, with a pull that halves at 4 cm.
TEST(MissingForce, Attraction) {
  BentStem bent;
  bent.measure({at(0.7,
                   [](double, const Vec3& x, const Vec3&) -> Vec3 {
                     const Vec3 away = Vec3(0.05, 0.02, 0.29) - x;
                     return 0.005 * 0.0016 / (0.0016 + away.squaredNorm()) * away.normalized();
                   })},
               5);
  expect_found(bent.infer(), "attraction to a point", 0.7);
}

// A knock of 3 mN within 0.2 s in the second trial.
TEST(MissingForce, Jolt) {
  BentStem bent;
  PointForce jolt = at(0.6, [](double t, const Vec3&, const Vec3&) -> Vec3 {
    return std::max(0.0, 1.0 - std::abs(t - 1.7) / 0.1) * Vec3(0, 0.003, 0);
  });
  jolt.trial = "trial_2";
  bent.measure({jolt}, 6);
  const MissingForce found = bent.infer();
  expect_found(found, "jolt", 0.6);
  ASSERT_FALSE(found.terms.empty());
  EXPECT_EQ(found.terms.front().force.words.at("trial"), "trial_2");
}

// All markers 1 mm aside for half a second: no force does that.
TEST(MissingForce, ShiftOfTheCameraIsNoForce) {
  BentStem bent;
  bent.measure({}, 7);
  Samples& markers = bent.experiment.trials[0].markers;
  for (int i = 0; i < markers.size(); ++i)
    if (markers.time[i] > 1.5 && markers.time[i] < 2.0)
      for (int m = 0; m < 5; ++m) markers.value(i, 3 * m + 1) += 1e-3;
  const MissingForce found = bent.infer();
  ASSERT_TRUE(found.found);
  EXPECT_EQ(found.kind, "sensor");
  EXPECT_FALSE(found.place);
}

// What a law does is what its description says: at rest on the side of the anchor a string hangs
// slack, beyond its length it pulls with stiffness times what it is longer by, and a stop pushes
// along its direction alone.
TEST(ForceTerm, LawsOfPlace) {
  plant::Effect force;
  force.name = missing_force;
  force.place = on_stem(0.5);
  force.words["kind"] = "string";
  force.numbers = {{"stiffness", {2.0}}, {"about", {0, 0, 0.2}}, {"towards", {1, 0, 0}},
                   {"tilt", {0, 0}},     {"distance", {0.1}},    {"offset", {0.01}}};
  const PointForce string = point_force(force);
  EXPECT_EQ(string.law(0, Vec3(0, 0, 0.2), Vec3::Zero()), Vec3::Zero());
  EXPECT_NEAR((string.law(0, Vec3(-0.03, 0, 0.2), Vec3::Zero()) - Vec3(0.04, 0, 0)).norm(), 0,
              1e-12);
  force.words["kind"] = "stop";
  const PointForce stop = point_force(force);
  EXPECT_NEAR((stop.law(0, Vec3(-0.03, 0.05, 0.2), Vec3::Zero()) - Vec3(0.04, 0, 0)).norm(), 0,
              1e-12);
  EXPECT_EQ(stop.law(0, Vec3(0.03, 0, 0.2), Vec3::Zero()), Vec3::Zero());
}

// A fit moves the force's numbers and place like those of any effect.
TEST(ForceTerm, NumbersAreFree) {
  plant::Effect force;
  force.name = missing_force;
  force.place = on_stem(0.5);
  force.words["kind"] = "drag";
  force.numbers["rate"] = {0.2};
  Hypothesis hypothesis = free_force(force, 0.01, 2.0);
  ASSERT_EQ(hypothesis.size(), 2);
  hypothesis.set_value(0, 0.4);
  hypothesis.set_value(1, 0.75);
  const Variant variant = hypothesis.variant();
  EXPECT_TRUE(variant.effects.empty());
  ASSERT_EQ(variant.forces.size(), 1u);
  EXPECT_EQ(variant.forces[0].place.at, 0.75);
  EXPECT_NEAR((variant.forces[0].law(0, Vec3::Zero(), Vec3(0, 0, 2)) - Vec3(0, 0, -0.8)).norm(), 0,
              1e-12);
}

}  // namespace pedicel::discrepancy
