// Fruits pulled off at several angles: whole diagnoses of data in which they come off by the plant
// file's threshold, or by a law that it lacks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/report/report.h"
#include "plugins/discrepancy/simulate/simulator.h"

namespace pedicel::discrepancy {
namespace {

constexpr double position_noise = 0.0003, force_noise = 0.01;  // m, N
constexpr double duration = 1.5, interval = 1.0 / 60.0;        // s

plant::PlantFile twig() {
  plant::PlantFile plant;
  plant.name = "twig";
  plant.shape = plant::Shape::rest;
  plant.material = {2.0e8, 0.3, 700.0, 0.01};
  plant.connect = 0.01;
  plant.distance = 0.02;
  const auto curve = [](const char* name, const Vec3& from, const Vec3& to, double radius) {
    plant::PlantCurve made;
    made.name = name;
    made.interpolation = plant::Interpolation::linear;
    made.points = {from, to};
    made.radius = {radius};
    return made;
  };
  plant.curves = {curve("stem", Vec3::Zero(), Vec3(0, 0, 0.4), 0.006),
                  curve("stalk", Vec3(0, 0, 0.3), Vec3(0.05, 0, 0.3), 0.003)};
  plant::PlantFruit fruit;
  fruit.name = "fruit";
  fruit.place = {"stalk", 1.0, {}};
  fruit.radius = 0.012;
  fruit.density = 900.0;
  fruit.detach.force = 3.0;
  plant.fruits = {fruit};
  return plant;
}

// The fruit is drawn away along a line, faster and faster for a second.
DrivenPath drawn_away(double angle) {
  DrivenPath path;
  for (double t = 0.0; t < duration; t += 0.01) {
    const double u = std::min(t, 1.0);
    const double way = 0.05 * (0.5 * (u - std::sin(M_PI * u) / M_PI) + std::max(0.0, t - 1.0));
    path.time.push_back(t);
    path.position.emplace_back(0.05 + way * std::cos(angle), 0.0, 0.3 + way * std::sin(angle));
  }
  return path;
}

Experiment pulls() {
  Experiment experiment;
  experiment.plant() = twig();
  experiment.noise = {position_noise, force_noise};
  for (const double at : {0.4, 0.75, 1.0})
    experiment.markers.push_back(
        {"m" + std::to_string(experiment.markers.size()), {"stem", at, {}}});
  for (const double degrees : {0.0, 20.0, 40.0, 55.0, 70.0, 85.0}) {
    Trial trial;
    trial.name = "pull_" + std::to_string(static_cast<int>(degrees));
    Hold hold;
    hold.place = {"stalk", 1.0, {}};
    hold.path = drawn_away(degrees * M_PI / 180.0);
    hold.stiffness = 800.0;
    trial.holds = {hold};
    for (double t = 0.0; t < duration; t += interval) trial.markers.time.push_back(t);
    trial.force.time = trial.markers.time;
    trial.markers.value.setZero(trial.markers.size(), 9);
    trial.force.value.setZero(trial.force.size(), 3);
    experiment.trials.push_back(trial);
  }
  return experiment;
}

void measure(Experiment& experiment, const Variant& truth) {
  // With the nodes that the plant file has, at which a law is told.
  Simulator simulator(experiment, {experiment.plant().distance, 1.0 / 1200, 0.0}, 2);
  std::vector<Simulator::Request> requests;
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t)
    requests.push_back({&truth, t});
  const std::vector<Prediction> seen = simulator.run(requests);
  Random random(7);
  for (std::size_t t = 0; t < seen.size(); ++t) {
    Trial& trial = experiment.trials[t];
    trial.markers.value = seen[t].markers;
    trial.force.value = seen[t].force;
    for (double& x : trial.markers.value.reshaped()) x += position_noise * random.normal();
    for (double& x : trial.force.value.reshaped()) x += force_noise * random.normal();
    trial.events = seen[t].events;
    ASSERT_EQ(trial.events.size(), 1u) << trial.name;
  }
}

Diagnosis diagnosed(const Variant& truth) {
  Experiment experiment = pulls();
  measure(experiment, truth);
  DiagnosisOptions options;
  options.threads = 2;
  return diagnose(experiment, options);
}

TEST(Detachment, AThresholdThatHoldsIsAdequate) {
  const Diagnosis found = diagnosed({});
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << headline(found.verdict);
  EXPECT_EQ(found.strength.broken, 6);
  EXPECT_FALSE(found.strength.needs_law()) << found.strength.summary();
}

// By moment: the stalk lets go the sooner, the more it is bent.
TEST(Detachment, ALawInPlaceOfTheThresholdIsNamed) {
  plant::Effect law;
  law.name = "detachment_law";
  law.numbers = {{"moment", {0.018}}};
  const Diagnosis found = diagnosed({{law}, {}});
  ASSERT_EQ(found.verdict.outcome, Outcome::named) << headline(found.verdict);
  ASSERT_EQ(found.verdict.causes.size(), 1u);
  const NamedCause& cause = found.verdict.causes.front();
  EXPECT_EQ(cause.name, "detachment_law");
  ASSERT_TRUE(cause.parameters.contains("moment")) << cause.because;
  const Estimate& moment = cause.parameters.at("moment").front();
  EXPECT_NEAR(moment.value, 0.018, 0.002);
  EXPECT_LT(moment.low, 0.018);
  EXPECT_GT(moment.high, 0.018);
  EXPECT_THAT(report_text(found.admission.experiment, found),
              testing::HasSubstr("<p>6 fruits came off at"));
  // The extended plant has it.
  const plant::PlantFile extended =
      extended_plant(found.admission.experiment, found.best.hypothesis);
  EXPECT_TRUE(std::ranges::any_of(extended.effects, [](const plant::Effect& effect) {
    return effect.name == "detachment_law";
  }));
}

}  // namespace
}  // namespace pedicel::discrepancy
