// Small hidden cases in records as people make them: whole diagnoses of a stem with two trials or
// three, simulated on a finer mesh than the diagnosis takes.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/report/report.h"
#include "plugins/discrepancy/simulate/simulator.h"

namespace pedicel::discrepancy {
namespace {

constexpr double position_noise = 3.0e-4, force_noise = 5.0e-3, moment_noise = 5.0e-4;
constexpr double interval = 0.01;  // s

/// A stem that leans, with five markers.
Experiment stem() {
  Experiment experiment;
  plant::PlantFile& plant = experiment.plant();
  plant.name = "stem";
  plant.shape = plant::Shape::rest;
  plant.material = {4.0e8, 0.35, 750.0, 0.01};
  plant.connect = 0.01;
  plant.distance = 0.025;
  plant::PlantCurve curve;
  curve.name = "stem";
  curve.interpolation = plant::Interpolation::linear;
  curve.points = {Vec3(0, 0, 0), Vec3(0.03, 0.01, 0.25), Vec3(0.1, 0.02, 0.5)};
  curve.radius = {0.004, 0.0035, 0.003};
  plant.curves = {curve};
  experiment.noise = {position_noise, force_noise, moment_noise};
  for (const double at : {0.2, 0.4, 0.6, 0.8, 1.0})
    experiment.markers.push_back(
        {"m" + std::to_string(experiment.markers.size() + 1), {"stem", at, {}}});
  return experiment;
}

Samples samples(double duration, Eigen::Index columns) {
  Samples made;
  for (int i = 0; i <= std::lround(duration / interval); ++i) made.time.push_back(interval * i);
  made.value.setZero(made.size(), columns);
  return made;
}

Trial& add_trial(Experiment& experiment, const std::string& name, double duration) {
  Trial trial;
  trial.name = trial.folder = name;
  trial.markers = samples(duration, 15);
  experiment.trials.push_back(std::move(trial));
  return experiment.trials.back();
}

/// A pull that lets go at once.
TimedLoad pull(const Vec3& force, double until) {
  TimedLoad load;
  load.place = {"stem", 0.9, {}};
  load.force = force;
  load.to = until;
  return load;
}

void add_noise(Samples& record, Eigen::Index first, Eigen::Index columns, double std,
               Random& random) {
  for (double& x : record.value.middleCols(first, columns).reshaped()) x += std * random.normal();
}

void measure(Experiment& experiment, const std::vector<plant::Effect>& hidden) {
  Simulator simulator(experiment, {0.0125, 1.0 / 1920}, 1);
  const Variant truth{hidden, {}};
  Random random(11);
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t) {
    const Simulator::Request request{&truth, t};
    const Prediction seen = simulator.run({&request, 1}).front();
    ASSERT_TRUE(seen.healthy);
    Trial& trial = experiment.trials[t];
    trial.markers.value = seen.markers;
    add_noise(trial.markers, 0, 15, position_noise, random);
    if (trial.force.size() > 0) {
      trial.force.value = seen.force;
      add_noise(trial.force, 0, 3, force_noise, random);
    }
    if (trial.wrench.size() > 0) {
      trial.wrench.value = seen.wrench;
      add_noise(trial.wrench, 0, 3, force_noise, random);
      add_noise(trial.wrench, 3, 3, moment_noise, random);
    }
  }
}

/// The first `time` (s) cut off: what was done is over, and the plant is in mid swing.
void cut(Trial& trial, double time) {
  const auto rows = static_cast<Eigen::Index>(std::lround(time / interval));
  trial.markers.value = trial.markers.value.bottomRows(trial.markers.size() - rows).eval();
  trial.markers.time.resize(trial.markers.time.size() - static_cast<std::size_t>(rows));
  trial.loads.clear();
  trial.window = 0.2;
}

Diagnosis diagnosed(const Experiment& experiment) {
  DiagnosisOptions options;
  options.threads = 1;
  return diagnose(experiment, options);
}

plant::Effect soft_root(double stiffness) {
  plant::Effect effect;
  effect.name = "base_compliance";
  effect.numbers["stiffness"] = {stiffness};
  return effect;
}

void expect_named(const Diagnosis& found, const std::string& name, const std::string& parameter,
                  double value, double within) {
  ASSERT_EQ(found.verdict.outcome, Outcome::named) << headline(found.verdict);
  ASSERT_EQ(found.verdict.causes.size(), 1u) << headline(found.verdict);
  const NamedCause& cause = found.verdict.causes.front();
  EXPECT_EQ(cause.name, name) << headline(found.verdict);
  ASSERT_TRUE(cause.parameters.contains(parameter));
  EXPECT_NEAR(cause.parameters.at(parameter).front().value / value, 1.0, within);
}

// Without a marker near the clamp, swings or pushes alone do not part a soft root from a weak
// stretch just above it: both may be told, the root first.
void expect_soft_root(const Diagnosis& found, double stiffness) {
  ASSERT_TRUE(found.verdict.outcome == Outcome::named ||
              found.verdict.outcome == Outcome::ambiguous)
      << headline(found.verdict);
  const NamedCause& cause = found.verdict.causes.at(0);
  EXPECT_EQ(cause.name, "base_compliance") << headline(found.verdict);
  EXPECT_NEAR(cause.parameters.at("stiffness").front().value / stiffness, 1.0, 0.15);
}

/// Three swings of which the record has neither the pull nor the first 0.3 s.
Experiment mid_swings(const std::vector<plant::Effect>& hidden) {
  Experiment experiment = stem();
  add_trial(experiment, "x", 2.0).loads = {pull(Vec3(0.12, 0, 0), 0.2)};
  add_trial(experiment, "y", 2.0).loads = {pull(Vec3(0, 0.12, 0), 0.2)};
  add_trial(experiment, "both", 2.0).loads = {pull(Vec3(-0.08, 0.08, 0), 0.2)};
  measure(experiment, hidden);
  for (Trial& trial : experiment.trials) cut(trial, 0.5);
  return experiment;
}

TEST(HiddenRecords, AMovingStartIsNeitherAForceNorBadData) {
  const Diagnosis found = diagnosed(mid_swings({}));
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << headline(found.verdict);
}

TEST(HiddenRecords, ASoftRootInMidSwing) {
  expect_soft_root(diagnosed(mid_swings({soft_root(1.5)})), 1.5);
}

/// Pushed aside by a probe that comes from beside the stem, slides along it, and goes back.
Experiment pushes(const std::vector<plant::Effect>& hidden) {
  Experiment experiment = stem();
  const std::vector<Vec3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3(0.6, -0.8, 0)};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Trial& trial = add_trial(experiment, "push" + std::to_string(i + 1), 3.0);
    trial.force = samples(3.0, 3);
    Hold hold;
    hold.place = {"stem", 0.75, {}};
    const Vec3 start(0.06, 0.015, 0.36);  // about where that is
    for (const double t : trial.force.time) {
      hold.path.time.push_back(t);
      hold.path.position.push_back(start + (-0.02 + 0.05 * (1.0 - std::cos(2.0 * M_PI * t / 3.0))) *
                                               axes[i]);
    }
    hold.path.file = "hold.csv";
    hold.axes = {axes[i]};
    hold.one_sided = true;
    hold.stiffness = 200.0;  // a rigid one would jerk the stem at each row of its path
    trial.holds = {hold};
  }
  measure(experiment, hidden);
  return experiment;
}

TEST(HiddenRecords, APusherIsNoBadData) {
  const Diagnosis found = diagnosed(pushes({}));
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << headline(found.verdict);
}

TEST(HiddenRecords, ASoftRootUnderAPusher) {
  expect_soft_root(diagnosed(pushes({soft_root(2.0)})), 2.0);
}

/// Let go, on a plate that feels force and moment.
Experiment on_a_plate(const std::vector<plant::Effect>& hidden) {
  Experiment experiment = stem();
  for (const bool along_x : {true, false}) {
    Trial& trial = add_trial(experiment, along_x ? "x" : "y", 2.0);
    trial.loads = {pull(along_x ? Vec3(0.12, 0, 0) : Vec3(0, 0.12, 0), 0.3)};
    trial.wrench = samples(2.0, 6);
    trial.wrench_file = "base_wrench.csv";
  }
  measure(experiment, hidden);
  return experiment;
}

TEST(HiddenRecords, AMassThatAForcePlateWeighs) {
  plant::Effect mass;
  mass.name = "extra_mass";
  mass.numbers["mass"] = {0.003};
  mass.place = plant::CurvePlace{"stem", 0.7, {}};
  const Diagnosis found = diagnosed(on_a_plate({mass}));
  expect_named(found, "extra_mass", "mass", 0.003, 0.1);
  ASSERT_TRUE(found.verdict.causes.front().where);
  EXPECT_NEAR(found.verdict.causes.front().where->at, 0.7, 0.05);
}

}  // namespace
}  // namespace pedicel::discrepancy
