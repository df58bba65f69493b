// Effects of one plant carried over to another one, longer and thicker, whose data were simulated
// with them or without.
#include "plugins/discrepancy/procedure/transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "engine/core/random.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double marker_noise = 2.0e-4;  // m

plant::Effect soft_root() {
  return testing::effect("base_compliance", "stiffness", {0.25});
}

/// Pulled aside in three directions and let go.
Experiment measured(const std::vector<plant::Effect>& hidden) {
  testing::Beam beam;
  beam.length = 0.5;
  beam.radius = 0.0035;
  beam.damping_time = 0.01;
  Experiment e = testing::experiment_of(beam, 1.0, 0.02);
  e.noise.position_std = marker_noise;
  e.trials[0].force = {};
  e.trials[0].gravity = Vec3(0, 0, -9.81);
  e.trials.resize(3, e.trials[0]);
  const std::array aside{Vec3(0.03, 0, 0), Vec3(0, 0.03, 0), Vec3(0.03, 0.02, 0)};
  for (int t = 0; t < 3; ++t) {
    e.trials[t].name = "trial_" + std::to_string(t);
    e.trials[t].holds.push_back({testing::on_stem(0.8),
                                 testing::resting_at(Vec3(0, 0, 0.8 * beam.length) + aside[t]), 0.2,
                                 20.0});
  }
  Variant variant;
  variant.effects = hidden;
  Simulator simulator(e, {0.02, 1.0 / 480.0}, 1);
  Random random(5);
  for (int t = 0; t < 3; ++t) {
    const Simulator::Request request{&variant, t};
    Eigen::MatrixXd seen = simulator.run(std::span(&request, 1)).front().markers;
    for (double& x : seen.reshaped()) x += marker_noise * random.normal();
    e.trials[t].markers.value = seen;
  }
  return e;
}

/// The first plant: softer than its file, with a soft root.
plant::PlantFile extended() {
  plant::PlantFile plant = testing::plant_of({});
  plant.effects = {testing::effect("youngs_modulus", "factor", {0.6}), soft_root()};
  return plant;
}

TEST(Transfer, HelpsAPlantThatHasTheEffect) {
  const Transfer found = transfer(extended(), measured({soft_root()}), {});
  EXPECT_THAT(found.effects, ElementsAre("base_compliance"));  // the modulus stays behind
  ASSERT_TRUE(found.gain);
  EXPECT_GT(*found.gain, 0.9);
  EXPECT_LT(*found.check.extended, 1.1);
  EXPECT_GT(*found.check.refitted, 1.2);
  EXPECT_THAT(found.sentence(), HasSubstr("carries over"));
  for (const auto& [name, factor] : found.extended)
    if (name == "youngs_modulus") {
      EXPECT_NEAR(factor, 1.0, 0.02);
    }
  const auto json = nlohmann::json::parse(to_json(found));
  EXPECT_EQ(json["format"], "pedicel-transfer");
  EXPECT_EQ(json["gain"], *found.gain);
}

TEST(Transfer, DoesNotHelpAPlantThatLacksIt) {
  const Transfer found = transfer(extended(), measured({}), {});
  EXPECT_LT(found.gain.value_or(0.0), 0.1);
  EXPECT_GT(*found.check.extended, *found.check.refitted);
}

TEST(Transfer, RefusesWhatTheOtherPlantLacks) {
  plant::PlantFile other = extended();
  plant::Effect mass = testing::effect("extra_mass", "mass", {0.01});
  mass.place = plant::CurvePlace{"branch", 0.5, {}};
  other.effects.push_back(mass);
  EXPECT_ANY_THROW(transfer(other, measured({}), {}));
}

}  // namespace
}  // namespace pedicel::discrepancy
