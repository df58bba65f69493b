#include "discrepancy/missing_force.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "beam_experiment.h"
#include "core/random.h"
#include "discrepancy/causes.h"
#include "discrepancy/force_term.h"
#include "discrepancy/places.h"

namespace pedicel::discrepancy {

using namespace testing;

namespace {

constexpr double noise_std = 2e-4;  // m

/// A stem of 0.4 m in ten elements (first frequency 2.9 Hz, 1/tip stiffness 1.7 m/N) that is pulled
/// aside in two directions by known loads and let go, with five markers.
struct Bent {
  Experiment experiment;

  Bent() {
    Beam beam;
    beam.damping_time = 0.01;
    experiment = experiment_of(beam, 2.5, 0.02);
    experiment.plant.distance = 0.04;
    experiment.markers.clear();
    for (const double at : {0.2, 0.4, 0.6, 0.8, 1.0})
      experiment.markers.push_back({"m" + std::to_string(at), on_stem(at)});
    Trial trial = experiment.trials.front();
    trial.gravity = Vec3(0, 0, -9.81);
    trial.markers = empty_samples(2.5, 0.02, 15);
    trial.force = {};
    experiment.trials.clear();
    const Vec3 pulls[] = {Vec3(0.03, 0.005, 0), Vec3(-0.012, 0.025, 0)};
    for (const Vec3& pull : pulls) {
      trial.name = "trial_" + std::to_string(experiment.trials.size() + 1);
      trial.loads = {{on_stem(1.0), pull, 0.2, 1.0}};
      experiment.trials.push_back(trial);
    }
  }

  double stem_length() const { return drawn_length(experiment.plant.curves.front()); }

  /// Measures what a stem with `forces` would do, with white noise on top.
  void measure(std::vector<PointForce> forces, std::uint64_t seed) {
    Simulator truth(experiment, {0.04, 1.0 / 480}, 1);
    Variant variant;
    variant.effects = {effect("youngs_modulus", "factor", {1.03})};
    variant.forces = std::move(forces);
    std::vector<Simulator::Request> requests{{&variant, 0}, {&variant, 1}};
    const std::vector<Prediction> seen = truth.run(requests);
    Random random(seed);
    for (std::size_t t = 0; t < seen.size(); ++t) {
      experiment.trials[t].markers.value = seen[t].markers;
      for (double& x : experiment.trials[t].markers.value.reshaped())
        x += noise_std * random.normal();
    }
  }

  /// About a model that is fitted from `start` in so many iterations.
  MissingForce infer(const Hypothesis& start = baseline(), int iterations = 60,
                     double least_evidence = 0.0) const {
    DataSet data(experiment);
    data.set_noise(white_noise(noise_std), white_noise(1.0));
    Simulator simulator(experiment, {0.04, 1.0 / 480}, 1);
    Evaluator evaluator(simulator, data);
    MissingForceOptions options;
    options.fit.trials = {0, 1};
    options.least_evidence = least_evidence;
    FitOptions around = options.fit;
    around.iterations = iterations;
    const FitSummary model = fit(evaluator, start, around);
    options.note = [](const std::string& s) {
      if (std::getenv("MISSING_NOTES")) std::puts(s.c_str());
    };
    const MissingForce found = infer_missing_force(evaluator, model, options);
    options.note(found.sentence());
    return found;
  }
};

PointForce at(double place, std::function<Vec3(double, const Vec3&, const Vec3&)> law) {
  return {on_stem(place), std::move(law), {}};
}

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
  Bent bent;
  bent.measure({}, 1);
  const MissingForce found = bent.infer();
  EXPECT_FALSE(found.found) << found.sentence();
  EXPECT_TRUE(found.sentence().empty());
}

// A string, slack at rest, a tenth as stiff as the stem.
TEST(MissingForce, String) {
  Bent bent;
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

// 3 mm beside the stem, on one side.
auto soft_stop() {
  return at(0.7, [](double, const Vec3& x, const Vec3&) -> Vec3 {
    const Vec3 n(0.8, 0.6, 0);
    return 0.15 * std::max(0.0, -0.003 - n.dot(x)) * n;
  });
}

TEST(MissingForce, Stop) {
  Bent bent;
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
  Bent bent;
  bent.measure({at(0.7,
                   [](double, const Vec3& x, const Vec3&) -> Vec3 {
                     return 20.0 * std::max(0.0, -0.002 - x.x()) * Vec3::UnitX();
                   })},
               8);
  const MissingForce found = bent.infer();
  ASSERT_TRUE(found.found);
  EXPECT_EQ(found.kind, "stop") << found.sentence();
  ASSERT_TRUE(found.place);
  EXPECT_NEAR(found.place->at, 0.7, 0.1);  // an element: from one to the next leads over a ridge
  // However loud it is, no place is known better than to a node: 40 mm, uniformly, of the stem.
  EXPECT_GE(found.place_error, 0.04 / std::sqrt(12.0) / bent.stem_length());
  EXPECT_GT(found.share, 0.9);
}

// A stop, asked for about a plant that nobody believes in: ten times as stiff, six times as heavy.
TEST(MissingForce, IsTriedOnThePlantThatWasBelievedIn) {
  Bent bent;
  bent.measure({soft_stop()}, 3);
  Hypothesis far = baseline();
  far.set_value(far.factor_on("youngs_modulus"), 9.0);
  far.set_value(far.factor_on("density"), 6.0);
  const MissingForce found = bent.infer(far, 0);
  expect_found(found, "stop", 0.7);
}

// Where known causes explain more than any force could, no law of one is looked for.
TEST(MissingForce, IsNotFollowedWhereItPromisesTooLittle) {
  Bent bent;
  bent.measure({soft_stop()}, 3);
  const MissingForce found = bent.infer(baseline(), 60, 1.0e6);
  EXPECT_FALSE(found.found) << found.sentence();
  EXPECT_TRUE(found.terms.empty());
  EXPECT_GT(found.simulations, 0);
}

// 0.6 mN at 1.7 Hz.
TEST(MissingForce, PeriodicPush) {
  Bent bent;
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
  Bent bent;
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
  Bent bent;
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
  Bent bent;
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
