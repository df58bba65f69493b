// Diagnoses with long steps where nothing moves, against the plain way: the same verdict, the same
// causes, and numbers that differ by a small part of their intervals. The data come from the
// reference simulator, whose steps know of no rests.
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/report/report.h"
#include "tests/discrepancy/resimulated.h"

namespace pedicel::hidden {
namespace {

using discrepancy::Diagnosis;
using discrepancy::Experiment;
using discrepancy::Trial;

constexpr double interval = 0.02;  // s

Experiment resting_stem() {
  Experiment experiment;
  plant::PlantFile& plant = experiment.plant();
  plant.name = "stem";
  plant.shape = plant::Shape::rest;
  plant.material = {4.0e8, 0.35, 750.0, 0.02};
  plant.connect = 0.01;
  plant.distance = 0.03;
  plant::PlantCurve curve;
  curve.name = "stem";
  curve.interpolation = plant::Interpolation::linear;
  curve.points = {Vec3(0, 0, 0), Vec3(0.02, 0.01, 0.2), Vec3(0.06, 0.02, 0.42)};
  curve.radius = {0.004, 0.0035, 0.003};
  plant.curves = {curve};
  experiment.noise = {3.0e-4, 5.0e-3};
  for (const double at : {0.3, 0.6, 1.0})
    experiment.markers.push_back(
        {"m" + std::to_string(experiment.markers.size() + 1), {"stem", at, {}}});
  return experiment;
}

void add_loads(Experiment& experiment, const std::string& name, const Vec3& first,
               const Vec3& second) {
  Trial trial;
  trial.name = trial.folder = name;
  for (int i = 0; i <= std::lround(7.0 / interval); ++i) trial.markers.time.push_back(interval * i);
  trial.markers.value.setZero(trial.markers.size(), 9);
  for (const auto& [force, from, to] :
       {std::tuple{first, -1.0, 3.0}, std::tuple{second, 5.0, 1.0e3}}) {
    discrepancy::TimedLoad load;
    load.place = {"stem", 0.95, {}};
    load.force = force;
    load.from = from;
    load.to = to;
    trial.loads.push_back(load);
  }
  experiment.trials.push_back(std::move(trial));
}

Experiment loaded(const std::vector<plant::Effect>& hidden, std::uint64_t seed) {
  Experiment experiment = resting_stem();
  add_loads(experiment, "x", Vec3(0.1, 0, 0), Vec3(0, 0.05, 0));
  add_loads(experiment, "y", Vec3(0, 0.1, 0), Vec3(0.05, 0, 0));
  add_loads(experiment, "both", Vec3(-0.06, 0.06, 0), Vec3(0, 0, -0.08));
  MeasuringOptions options;
  options.seed = seed;
  return resimulated(std::move(experiment), hidden, {}, options);
}

Diagnosis diagnosed(const Experiment& experiment, int quiet_steps) {
  discrepancy::DiagnosisOptions options;
  options.threads = 1;
  options.settings.accuracy.quiet_steps = quiet_steps;
  return diagnose(experiment, options);
}

void expect_close(const discrepancy::Estimate& quick, const discrepancy::Estimate& plain,
                  const std::string& what) {
  // Of half an interval, or of the number itself where that is open.
  const double width = std::isfinite(plain.high - plain.low) ? 0.5 * (plain.high - plain.low)
                                                             : 0.1 * std::abs(plain.value);
  EXPECT_NEAR(quick.value, plain.value, 0.25 * width + 1.0e-12) << what;
}

void expect_same_verdict(const std::vector<plant::Effect>& hidden, std::uint64_t seed) {
  const Experiment experiment = loaded(hidden, seed);
  const Diagnosis quick = diagnosed(experiment, 4), plain = diagnosed(experiment, 1);
  ASSERT_EQ(quick.verdict.outcome, plain.verdict.outcome) << headline(quick.verdict);
  ASSERT_EQ(quick.verdict.causes.size(), plain.verdict.causes.size()) << headline(quick.verdict);
  for (std::size_t c = 0; c < plain.verdict.causes.size(); ++c) {
    const auto &a = quick.verdict.causes[c], &b = plain.verdict.causes[c];
    ASSERT_EQ(a.name, b.name);
    for (const auto& [name, numbers] : b.parameters)
      for (std::size_t i = 0; i < numbers.size(); ++i)
        expect_close(a.parameters.at(name)[i], numbers[i], a.name + " " + name);
    ASSERT_EQ(a.share.fit.has_value(), b.share.fit.has_value()) << a.name;
    if (b.share.fit) {
      EXPECT_NEAR(*a.share.fit, *b.share.fit, 0.02) << a.name;
    }
  }
  for (const auto& [name, number] : plain.verdict.parameters)
    expect_close(quick.verdict.parameters.at(name), number, name);
  EXPECT_NEAR(*quick.verdict.fit.extended / *plain.verdict.fit.extended, 1.0, 0.01);
}

plant::Effect hidden_effect(const std::string& name, const std::string& parameter, double value) {
  plant::Effect effect;
  effect.name = name;
  effect.numbers[parameter] = {value};
  return effect;
}

TEST(QuietSteps, NothingHidden) {
  expect_same_verdict({}, 4);
}

TEST(QuietSteps, ASofterPlantThatIsDampedMore) {
  expect_same_verdict({hidden_effect("youngs_modulus", "factor", 0.8),
                       hidden_effect("damping_time", "factor", 1.5)},
                      5);
}

TEST(QuietSteps, ASoftRoot) {
  expect_same_verdict({hidden_effect("base_compliance", "stiffness", 2.0)}, 6);
}

TEST(QuietSteps, AMass) {
  plant::Effect mass = hidden_effect("extra_mass", "mass", 0.004);
  mass.place = plant::CurvePlace{"stem", 0.7, {}};
  expect_same_verdict({mass}, 7);
}

}  // namespace
}  // namespace pedicel::hidden
