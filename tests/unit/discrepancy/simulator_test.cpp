// Predictions against beam theory (Euler-Bernoulli, small deflections; shear adds less than 1e-3 at
// this slenderness) and against each other.
#include "plugins/discrepancy/simulate/simulator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/check.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::Beam;
using testing::effect;
using testing::experiment_of;
using testing::on_stem;

constexpr double offset = 0.004;  // m, a hundredth of the length

Prediction predict(const Experiment& experiment, const Variant& variant = {},
                   const Numerics& numerics = {0.02, 1.0 / 480}) {
  Simulator simulator(experiment, numerics, 1);
  const Simulator::Request request{&variant, 0};
  return simulator.run({&request, 1}).front();
}

Experiment loaded(double from, double to) {
  Experiment experiment = experiment_of({}, 0.1);
  experiment.trials[0].loads.push_back({on_stem(1.0), Vec3(0.01, 0, 0), from, to});
  return experiment;
}

// w(x) = F x^2 (3 L - x) / (6 EI); the markers sit between nodes (20 segments: the middle is a node
// at 0.02, so 0.51 and 0.99 of the length are taken).
TEST(Simulator, RestsUnderItsLoadAtTimeZero) {
  const Beam beam;
  Experiment experiment = loaded(-1.0, 1.0);
  experiment.markers = {{"a", on_stem(0.51)}, {"b", on_stem(0.99)}};
  const Prediction found = predict(experiment);
  ASSERT_TRUE(found.healthy);
  for (int m = 0; m < 2; ++m) {
    const double x = experiment.markers[m].place.at * beam.length;
    const double expected = 0.01 * x * x * (3.0 * beam.length - x) / (6.0 * beam.stiffness());
    EXPECT_NEAR(found.markers(0, 3 * m) / expected, 1.0, 5e-3) << m;
    EXPECT_NEAR(found.markers(0, 3 * m + 2), x, 1e-3);
    // And stays there.
    EXPECT_NEAR(found.markers(10, 3 * m), found.markers(0, 3 * m), 1e-8);
  }
}

// A branch across a loaded stem, weightless: it turns with the junction, by F x (2 L - x) / (2 EI).
// Without a short segment below, half of the segment there does not bend for it: 0.02 of 0.3 m.
TEST(Simulator, ABranchTurnsWithItsJunction) {
  const Beam beam;
  Experiment experiment = loaded(-1.0, 1.0);
  experiment.trials[0].loads[0].force *= 0.1;
  plant::PlantCurve branch = experiment.plant().curves[0];
  branch.name = "branch";
  branch.points = {Vec3(0, 0, 0.2), Vec3(0.1, 0, 0.2)};
  experiment.plant().curves.push_back(branch);
  experiment.markers = {{"foot", {"branch", 0.0, {}}}, {"end", {"branch", 1.0, {}}}};
  const double turn = 0.001 * 0.2 * (2.0 * beam.length - 0.2) / (2.0 * beam.stiffness());
  const auto found = [&](double junction) {
    const Eigen::MatrixXd at = predict(experiment, {}, {0.04, 1.0 / 480, junction}).markers;
    return (at(0, 2) - at(0, 5)) / 0.1 / turn;
  };
  EXPECT_NEAR(found(0.05), 1.0, 0.01);
  EXPECT_NEAR(found(0.0), 1.0 - 0.02 / 0.3, 0.01);
}

// Two springs in series: the hold and the beam's tip.
TEST(Simulator, AHoldPullsThroughItsSpring) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.05);
  Hold hold{on_stem(1.0), testing::resting_at(Vec3(offset, 0, beam.length)), {}, 20.0};
  hold.release = 0.04;
  experiment.trials[0].holds = {hold};
  const double series = 1.0 / (1.0 / 20.0 + 1.0 / beam.tip_stiffness());
  const Prediction found = predict(experiment);
  EXPECT_NEAR(found.force(0, 0) / (series * offset), 1.0, 5e-3);
  EXPECT_NEAR(found.force(0, 0), 20.0 * (offset - found.markers(0, 3)), 1e-9);
  EXPECT_NEAR(found.force(3, 0), found.force(0, 0), 1e-8);
  EXPECT_EQ(found.force(4, 0), 0.0);  // at the release itself
  // In place of what the drive states.
  const Variant soft{{effect("grip_compliance", "stiffness", {5.0})}, {}};
  const double softer = 1.0 / (1.0 / 5.0 + 1.0 / beam.tip_stiffness());
  EXPECT_NEAR(predict(experiment, soft).force(0, 0) / (softer * offset), 1.0, 5e-3);
}

TEST(Simulator, ARigidHoldFollowsItsPath) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.5);
  DrivenPath path;
  for (int i = 0; i <= 50; ++i) {
    path.time.push_back(0.01 * i);
    path.position.emplace_back(offset * std::pow(std::sin(0.01 * i * M_PI), 2), 0, beam.length);
  }
  experiment.trials[0].holds = {{on_stem(1.0), path, INFINITY, std::nullopt}};
  const Prediction found = predict(experiment);
  ASSERT_TRUE(found.healthy);
  for (int s = 0; s <= 50; ++s) EXPECT_NEAR(found.markers(s, 3), path.position[s].x(), 1e-6) << s;
}

// The tip's height is held too, so the stem is stretched a little: the force across is beam
// theory's plus that tension's. Held at 0.5 it is 3 EI w / x^3 with x the held length.
TEST(Simulator, AGripThatSlipsHoldsElsewhere) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.4);
  experiment.trials[0].holds = {
      {on_stem(0.5), testing::resting_at(Vec3(0.001, 0, 0.5 * beam.length)), INFINITY, 100.0}};
  plant::Effect slip = effect("grip_slip", "distance", {0.1});
  slip.numbers["time"] = {0.2};
  Variant variant{{slip}, {}};
  const Prediction found = predict(experiment, variant);
  // The spring now pulls the place at 0.75 down to the height of 0.5, harder than it did.
  EXPECT_NEAR(found.force(19, 2), 0.0, 1e-3);
  EXPECT_NEAR(found.force(20, 2), -100.0 * 0.1, 0.05);
}

// Much slower than the first frequency (w1 = 33 rad/s) the plant goes along as it is, bent by its
// inertia as by a load along it: the tip lags by rho A a L^4 / (8 EI), 0.9 mm at most. What is left
// comes with that lag's rate, 2.8 mm/s at first: ringing of rate / w1 = 85 um, and the damping's
// delay of 0.02 s, 56 um.
TEST(Simulator, ASlowBaseCarriesThePlant) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 2.0, 0.1);
  DrivenPath base;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.02 * i, ramp = t - std::sin(M_PI * t) / M_PI;  // 0 to 2, smooth at its ends
    base.time.push_back(t);
    base.position.emplace_back(1.0 + 0.05 * ramp, 0.2, 0.1);
    base.rotation.push_back(Quat(Eigen::AngleAxisd(0.1 * ramp, Vec3::UnitZ())));
  }
  experiment.trials[0].base = base;
  experiment.plant().material.damping_time = 0.02;
  const Prediction found = predict(experiment);
  EXPECT_LT((found.markers.row(0).tail<3>() - Eigen::RowVector3d(1.0, 0.2, 0.5)).norm(), 1e-9);
  for (int s = 0; s <= 20; ++s) {
    const double acceleration = 0.05 * M_PI * std::sin(M_PI * 0.1 * s);
    const double lag =
        beam.mass_per_length() * acceleration * std::pow(beam.length, 4) / (8.0 * beam.stiffness());
    EXPECT_NEAR(found.markers(s, 3), base.position_at(0.1 * s).x() - lag, 2e-4) << s;
    EXPECT_NEAR(found.markers(s, 4), 0.2, 1e-5) << s;
  }
}

TEST(Simulator, TrialMassesWeighAndAreInert) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.01);
  experiment.trials[0].gravity = Vec3(0.5, 0, 0);  // across the stem: a weight is a load
  const double bare = predict(experiment).markers(0, 3);
  experiment.trials[0].masses = {{on_stem(1.0), 0.001}};
  const double hung = predict(experiment).markers(0, 3);
  EXPECT_NEAR((hung - bare) * beam.tip_stiffness() / (0.001 * 0.5), 1.0, 5e-3);
}

// Hung for long under its weight, w L^4 / (8 (1 - f) EI), and then with a mass at the tip, to which
// it answers with all of its stiffness, m g L^3 / (3 EI). The file's own mass had hung along.
TEST(Simulator, WhatStartsHungHadRelaxedBeforeTheTrialsMasses) {
  const Beam beam;
  constexpr double fraction = 0.5, g = 0.4, mass = 0.005;
  Experiment experiment = experiment_of(beam, 0.05);
  experiment.trials[0].gravity = Vec3(g, 0, 0);
  Variant variant;
  variant.effects = {effect("creep", "fraction", {fraction})};
  variant.effects[0].numbers["time"] = {1.0e6};
  variant.effects[0].words["start"] = "hung";
  const double cube = std::pow(beam.length, 3) / beam.stiffness();
  const double weight = beam.mass_per_length() * g * beam.length * cube / 8.0;
  const double hung = mass * g * cube / 3.0;
  const auto tip = [&] {
    const Prediction found = predict(experiment, variant);
    EXPECT_TRUE(found.healthy);
    EXPECT_NEAR(found.markers(5, 3), found.markers(0, 3), 1e-6);  // it rests
    return found.markers(0, 3);
  };
  EXPECT_NEAR(tip() / (weight / (1.0 - fraction)), 1.0, 5e-3);
  experiment.trials[0].masses = {{on_stem(1.0), mass}};
  EXPECT_NEAR(tip() / (weight / (1.0 - fraction) + hung), 1.0, 5e-3);
  experiment.plant().masses = {{on_stem(1.0), mass}};
  experiment.trials[0].masses.clear();
  EXPECT_NEAR(tip() / ((weight + hung) / (1.0 - fraction)), 1.0, 5e-3);
}

TEST(Simulator, AConstantPointForceIsALoad) {
  const Experiment bare = experiment_of({}, 0.1);
  Variant variant;
  variant.forces.push_back(
      {on_stem(1.0), [](double, const Vec3&, const Vec3&) { return Vec3(0.01, 0, 0); }, {}});
  EXPECT_LT((predict(bare, variant).markers - predict(loaded(-1, 1)).markers).norm(), 1e-8);
}

// A stem that carries a load unknown to the model: springs at the markers have to give it back.
TEST(Simulator, TrackingForcesAreTheLoadsThatTheModelLacks) {
  Experiment truth = loaded(-1.0, 1.0);
  truth.markers = {{"tip", on_stem(1.0)}};
  Experiment known = truth;
  known.trials[0].loads.clear();
  known.trials[0].markers.value = predict(truth).markers;
  known.trials[0].markers.value.row(5).setConstant(NAN);
  Simulator simulator(known, {0.02, 1.0 / 480}, 1);
  const Eigen::MatrixXd found = simulator.tracking_forces({}, 0, 1.0e4);
  // The spring gives way by force / stiffness: share of the beam's own stiffness in both; its
  // deflection is 4 % of its length.
  const double share = 1.0e4 / (1.0e4 + Beam().tip_stiffness());
  EXPECT_NEAR(found(0, 0) / (0.01 * share), 1.0, 3e-3);
  EXPECT_EQ(found(5, 0), 0.0);  // not seen
}

TEST(Simulator, LaterSamplesStayUnknown) {
  const Experiment experiment = loaded(-1.0, 1.0);
  Simulator simulator(experiment, {0.02, 1.0 / 480}, 1);
  const Variant variant;
  const Simulator::Request request{&variant, 0, 0.05};
  const Prediction found = simulator.run({&request, 1}).front();
  EXPECT_FALSE(found.markers.topRows(6).hasNaN());
  EXPECT_TRUE(found.markers.bottomRows(5).array().isNaN().all());
  EXPECT_TRUE(found.force.bottomRows(5).array().isNaN().all());
}

TEST(Simulator, WhatCannotBeSimulatedIsRefused) {
  const Experiment experiment = loaded(-1.0, 1.0);
  Simulator simulator(experiment, {0.02, 1.0 / 480}, 1);
  const Variant variant{{effect("no_such_effect", "x", {1.0})}, {}};
  const Simulator::Request request{&variant, 0};
  EXPECT_THROW(simulator.run({&request, 1}), UsageError);
}

// 0.1 N of a fruit of 10 g at the tip of a stem that leans out level, and a threshold of 0.05 N: at
// rest it would come off at once; where it was recorded, it does so then and not before.
TEST(Simulator, FruitsComeOffWhenItWasRecorded) {
  Experiment experiment = experiment_of({}, 0.5);
  experiment.plant().curves[0].points = {Vec3(0, 0, 0), Vec3(0.4, 0, 0)};
  plant::PlantFruit fruit;
  fruit.name = "fruit";
  fruit.place = on_stem(1.0);
  fruit.radius = 0.013;
  fruit.density = 0.01 / (4.0 / 3.0 * M_PI * std::pow(fruit.radius, 3));
  fruit.detach.force = 0.05;
  experiment.plant().fruits = {fruit};
  experiment.trials[0].gravity = Vec3(0, 0, -9.81);
  const Prediction by_threshold = predict(experiment);
  ASSERT_EQ(by_threshold.events.size(), 1u);
  EXPECT_LT(by_threshold.events[0].time, 0.01);

  experiment.trials[0].events = {{0.25, "detached", "fruit"}};
  const Prediction recorded = predict(experiment);
  ASSERT_EQ(recorded.events.size(), 1u);
  EXPECT_DOUBLE_EQ(recorded.events[0].time, 0.25);
  EXPECT_EQ(recorded.events[0].what, "fruit");
  EXPECT_NEAR(recorded.markers(24, 2), recorded.markers(0, 2), 1e-6);  // at rest until then
  EXPECT_GT(recorded.markers(35, 2), recorded.markers(0, 2) + 0.002);  // the middle springs up

  Simulator simulator(experiment, {0.02, 1.0 / 480}, 1);
  const std::vector<StalkLoads> stalks = simulator.stalk_loads({}, 0);
  ASSERT_EQ(stalks.size(), 1u);
  EXPECT_DOUBLE_EQ(stalks[0].came_off, 0.25);
  EXPECT_DOUBLE_EQ(stalks[0].time.back(), 0.25);
  // The tip's element and its fruit hang on the joint: 10 g and 1/20 of a stem of 9 g.
  EXPECT_NEAR(stalks[0].load.front()[stalk_force], 9.81 * 0.0104, 0.003);
}

// The bits of an answer depend on nothing but the request: alone, among others, on two threads,
// asked for again, shorter first.
TEST(Simulator, AnswersDoNotDependOnWhatElseIsAsked) {
  Experiment experiment = experiment_of({}, 0.3);
  experiment.plant().material.damping_time = 0.01;
  Hold hold{on_stem(0.73), testing::resting_at(Vec3(0.02, 0, 0.29)), 0.107, 80.0};
  experiment.trials[0].holds = {hold};
  experiment.trials.push_back(experiment.trials[0]);
  experiment.trials[1].holds.clear();
  experiment.trials[1].loads = {{on_stem(0.9), Vec3(0.02, 0.01, 0), 0.05, 0.2}};
  std::vector<Variant> variants(11);
  for (int v = 0; v < 11; ++v) {
    variants[v].effects = {effect("youngs_modulus", "factor", {1.0 + 0.1 * (v / 2)})};
    if (v % 2 == 1) variants[v].effects.push_back(effect("latency", "delay", {0.013}));
  }
  std::vector<Simulator::Request> requests;
  for (const Variant& variant : variants)
    for (int trial = 0; trial < 2; ++trial) requests.push_back({&variant, trial});
  const Numerics numerics{0.02, 1.0 / 240};
  Simulator together(experiment, numerics, 2);
  const std::vector<Prediction> all = together.run(requests);
  EXPECT_EQ(together.simulations(), 12);  // the latency is the sensor's
  const std::vector<Prediction> again = together.run(requests);
  EXPECT_EQ(together.simulations(), 12);
  for (std::size_t r = 0; r < requests.size(); ++r) {
    Simulator alone(experiment, numerics, 1);
    const Simulator::Request part{requests[r].variant, requests[r].trial, 0.1};
    alone.run({&part, 1});
    const Prediction one = alone.run({&requests[r], 1}).front();
    EXPECT_EQ(one.markers, all[r].markers) << r;
    EXPECT_EQ(one.force, all[r].force) << r;
    EXPECT_EQ(again[r].markers, all[r].markers) << r;
  }
}

}  // namespace
}  // namespace pedicel::discrepancy
