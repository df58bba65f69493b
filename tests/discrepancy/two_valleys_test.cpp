// A cause whose fit has two valleys, one about the refitted baseline and one about the nominal
// model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/simulate/simulator.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 0.0003;  // m

plant::PlantFile stem() {
  plant::PlantFile plant;
  plant.name = "young stem";
  plant.material = {4.0e8, 0.35, 800.0, 0.004};
  plant.connect = 0.005;
  plant.distance = 0.025;
  plant::PlantCurve curve;
  curve.name = "stem";
  curve.points = {Vec3(0, 0, 0), Vec3(0, 0, 0.5)};
  curve.radius = {0.005, 0.0035};
  plant.curves = {curve};
  return plant;
}

Trial trial(const std::string& name, double duration) {
  Trial made;
  made.name = name;
  for (double t = 0.0; t < duration + 0.01; t += 0.02) made.markers.time.push_back(t);
  made.markers.value.setZero(made.markers.size(), 9);
  return made;
}

/// Pulled aside within half a second and let go; then bent by a weight in two steps and back.
Experiment measured() {
  Experiment e;
  e.plant() = stem();
  e.noise.position_std = noise;
  e.markers = {
      {"low", {"stem", 0.35, {}}}, {"middle", {"stem", 0.65, {}}}, {"top", {"stem", 0.95, {}}}};
  Trial release = trial("release", 2.4);
  Hold hold;
  hold.place = {"stem", 0.8, {}};
  hold.stiffness = 200.0;
  hold.release = 0.5;
  for (int i = 0; i <= 10; ++i) {
    const double s = 0.1 * i;
    hold.path.time.push_back(0.5 * s);
    hold.path.position.emplace_back(0.03 * s * s * (3.0 - 2.0 * s), 0.0, 0.4);
  }
  release.holds = {hold};
  Trial weights = trial("weights", 20.0);
  for (const auto& [force, from] : {std::pair{0.163, 4.0}, {0.327, 8.0}, {0.163, 12.0}})
    weights.loads.push_back({{"stem", 0.5, {}}, Vec3(force, 0, 0), from, from + 4.0});
  e.trials = {release, weights};

  Variant variant;
  plant::Effect root;
  root.name = "base_compliance";
  root.numbers["stiffness"] = {1.5};
  variant.effects = {root};
  Simulator simulator(e, {0.005, 1.0 / 1920}, 2);
  Random random(1);
  for (int t = 0; t < 2; ++t) {
    const Simulator::Request request{&variant, t};
    Eigen::MatrixXd seen = simulator.run(std::span(&request, 1)).front().markers;
    for (double& x : seen.reshaped()) x += noise * random.normal();
    e.trials[t].markers.value = seen;
  }
  return e;
}

// From the refitted baseline alone the soft root's fit stays in a valley with half the modulus, and
// a modulus that falls along the stem, with 1.9 times the modulus, explains nearly all.
TEST(TwoValleys, ACauseIsAlsoStartedFromTheNominalModel) {
  DiagnosisOptions options;
  options.threads = 2;
  const Verdict verdict = diagnose(measured(), options).verdict;
  ASSERT_EQ(verdict.causes.size(), 1u);
  EXPECT_EQ(verdict.causes.front().name, "base_compliance");
}

}  // namespace
}  // namespace pedicel::discrepancy
