// Data are made with known parameters, another step and another mesh, and the parameters must come
// back within their intervals.
#include "plugins/discrepancy/fit/parameter_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "plugins/discrepancy/fit/parameter_request.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

constexpr double noise = 3.0e-4;  // m

void measure(Experiment& experiment, const Variant& truth) {
  experiment.noise.position_std = noise;
  Simulator simulator(experiment, {0.01, 1.0 / 1000}, 1);
  Random random(11);
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t) {
    const Simulator::Request request{&truth, t};
    Trial& trial = experiment.trials[t];
    trial.markers.value = simulator.run(std::span(&request, 1)).front().markers;
    for (double& x : trial.markers.value.reshaped()) x += noise * random.normal();
  }
}

Variant with(const std::string& effect, double factor) {
  return {{testing::effect(effect, "factor", {factor})}, {}};
}

/// Held aside by 4 cm and let go at 0.1 s: sees modulus over density and the damping.
Experiment release() {
  testing::Beam beam;
  beam.damping_time = 0.003;
  Experiment experiment = testing::experiment_of(beam, 1.0);
  Trial& trial = experiment.trials[0];
  trial.force = {};
  trial.holds = {{testing::on_stem(1.0), testing::resting_at(Vec3(0.04, 0, 0.4)), 0.1, 50.0}};
  return experiment;
}

/// A weight across the tip, at rest: sees the modulus alone.
Experiment static_load() {
  Experiment experiment = testing::experiment_of({}, 0.5);
  Trial& trial = experiment.trials[0];
  trial.force = {};
  trial.loads = {{testing::on_stem(1.0), Vec3(0.02, 0, 0)}};
  return experiment;
}

const FittedParameter& named(const ParameterFit& fit, const std::string& name) {
  for (const FittedParameter& p : fit.parameters)
    if (p.name == name) return p;
  throw std::out_of_range(name);
}

TEST(ParameterFit, FindsAKnownModulusAndDamping) {
  Experiment experiment = release();
  Variant truth = with("youngs_modulus", 1.3);
  truth.effects.push_back(testing::effect("damping_time", "factor", {0.8}));
  measure(experiment, truth);
  const ParameterFit fit = fit_parameters(
      experiment, requested_starts(experiment, {"youngs_modulus", "damping_time"}), {});
  const FittedParameter& modulus = named(fit, "youngs_modulus");
  EXPECT_EQ(modulus.unit, "Pa");
  EXPECT_LT(modulus.low, 2.6e8);
  EXPECT_GT(modulus.high, 2.6e8);
  EXPECT_LT(modulus.high - modulus.low, 0.02 * 2.6e8);
  const FittedParameter& damping = named(fit, "damping_time");
  EXPECT_LT(damping.low, 0.0024);
  EXPECT_GT(damping.high, 0.0024);
  EXPECT_NEAR(fit.trials.at(0).rms, 1.0, 0.1);  // 606 numbers: 3 % in one standard deviation
  EXPECT_FALSE(fit.summary.why.empty());
  const auto json = nlohmann::json::parse(to_json(fit));
  EXPECT_EQ(json.at("parameters").at(0).at("value"), modulus.value);
  EXPECT_THAT(to_table(fit), HasSubstr("youngs_modulus"));
}

TEST(ParameterFit, FindsAnEffectsParameterAtItsPlace) {
  Experiment experiment = release();
  Variant truth;
  plant::Effect mass = testing::effect("extra_mass", "mass", {0.004});
  mass.place = testing::on_stem(0.7);
  truth.effects = {mass};
  measure(experiment, truth);
  const ParameterFit fit =
      fit_parameters(experiment, requested_starts(experiment, {"extra_mass.mass@stem:0.7"}), {});
  const FittedParameter& found = named(fit, "extra_mass.mass@stem:0.7");
  EXPECT_EQ(found.unit, "kg");
  EXPECT_LT(found.low, 0.004);
  EXPECT_GT(found.high, 0.004);
}

TEST(ParameterFit, SaysWhatTheDataCannotSee) {
  Experiment experiment = static_load();
  measure(experiment, with("youngs_modulus", 0.9));
  const ParameterFit fit = fit_parameters(
      experiment, requested_starts(experiment, {"youngs_modulus", "density", "damping_time"}), {});
  EXPECT_TRUE(named(fit, "youngs_modulus").seen);
  EXPECT_LT(named(fit, "youngs_modulus").low, 1.8e8);
  EXPECT_GT(named(fit, "youngs_modulus").high, 1.8e8);
  EXPECT_FALSE(named(fit, "density").seen);
  EXPECT_FALSE(named(fit, "damping_time").seen);
  EXPECT_EQ(named(fit, "density").value, 800.0);  // as given
  EXPECT_THAT(to_table(fit), HasSubstr("these data cannot see it"));
}

TEST(ParameterFit, SaysWhatTheDataSeeOnlyTogether) {
  Experiment experiment = release();
  // Held rigidly, a bare beam's motion is of modulus over density alone: both run away together.
  experiment.trials[0].holds[0].stiffness.reset();
  measure(experiment, {});
  const ParameterFit fit =
      fit_parameters(experiment, requested_starts(experiment, {"youngs_modulus", "density"}), {});
  EXPECT_FALSE(named(fit, "density").seen) << to_table(fit);
  EXPECT_GT(fit.summary.condition, 100.0);
}

TEST(ParameterRequest, RefusesWhatItDoesNotKnow) {
  const Experiment experiment = release();
  const auto refusal = [&](std::vector<std::string> words) -> std::string {
    try {
      requested_starts(experiment, words);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({"stiffness"}), HasSubstr("fit stiffness: expected youngs_modulus, density"));
  EXPECT_THAT(refusal({"magic.mass"}), HasSubstr("of a known effect"));
  EXPECT_THAT(refusal({"extra_mass.size@stem:0.5"}),
              HasSubstr("extra_mass has no \"size\", expected one of mass"));
  EXPECT_THAT(refusal({"extra_mass.mass"}), HasSubstr("extra_mass needs a place: @CURVE:AT"));
  EXPECT_THAT(refusal({"extra_mass.mass@twig:0.5"}), HasSubstr("no curve \"twig\""));
  EXPECT_THAT(refusal({"extra_mass.mass@stem:1.5"}), HasSubstr("expected CURVE:AT"));
  EXPECT_THAT(refusal({"weak_segment.factor@stem:0.5"}), HasSubstr("also needs length"));
  EXPECT_THAT(refusal({"weak_segment.factor@stem:0.5", "weak_segment.length=-1"}),
              HasSubstr("not a number that it may be"));
  EXPECT_THAT(refusal({"mass_damping.rate@stem:0.5"}), HasSubstr("has no place"));
  EXPECT_THAT(refusal({"force_gain.gain", "force_gain.offset"}),
              HasSubstr("cannot be fitted to this experiment"));
  EXPECT_THAT(refusal({"density", "density"}), HasSubstr("named twice"));
}

TEST(ParameterRequest, ReadsPlacesAndGivenNumbers) {
  const Experiment experiment = release();
  const auto starts =
      requested_starts(experiment, {"weak_segment.factor@stem:0.3", "weak_segment.factor@stem:0.6",
                                    "weak_segment.length=0.02", "relaxation.fraction",
                                    "relaxation.time=2", "relaxation.start=unloaded"});
  ASSERT_FALSE(starts.empty());
  const Hypothesis& model = starts.front();
  ASSERT_EQ(model.effects.size(), 3u);
  EXPECT_EQ(model.effects[0].place->at, 0.3);
  EXPECT_EQ(model.effects[1].place->at, 0.6);
  EXPECT_EQ(model.effects[1].number("length"), 0.02);
  EXPECT_EQ(model.effects[2].number("time"), 2.0);
  EXPECT_EQ(model.effects[2].words.at("start"), "unloaded");
  EXPECT_EQ(model.size(), 3);
}

}  // namespace
}  // namespace pedicel::discrepancy
