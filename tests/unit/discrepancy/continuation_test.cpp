// A mass that no model knows raises the density that is fitted; from there it must be found by
// going back to the density that is believed.
#include "plugins/discrepancy/select/continuation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/random.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 2.0e-4;       // m
constexpr double hidden_mass = 0.004;  // kg, of the beam's 9 g
constexpr Numerics numerics{0.05, 1.0 / 240.0};

/// A beam with a mass at 0.75, pulled aside and let go; the force of the hold is known, so that
/// modulus is.
struct Weighted {
  Experiment experiment = made();
  DataSet data{experiment};
  Simulator simulator{experiment, numerics, 1};
  Evaluator evaluator{simulator, data};
  FitOptions options;
  FitSummary base;
  std::vector<Direction> directions;

  Weighted() {
    data.set_noise(white_noise(noise), white_noise(1.0e-3));
    options.trials = {0};
    base.cost = std::numeric_limits<double>::infinity();
    for (const double density : {1.2, 1.4, 1.6, 1.8, 2.0, 2.2}) {
      Hypothesis start = baseline();
      start.set_value(start.factor_on("density"), density);
      FitSummary found = fit(evaluator, start, options);
      if (found.cost < base.cost) base = std::move(found);
    }
    std::vector<Cause> causes;
    for (Cause& cause : candidate_causes(experiment, scales_of(experiment)))
      for (const char* chosen : {"extra_mass", "latency"})
        if (cause.name == chosen) causes.push_back(std::move(cause));
    directions = directions_of(evaluator, base, causes, options);
  }

  static Experiment made() {
    testing::Beam beam;
    beam.damping_time = 0.01;
    Experiment e = testing::experiment_of(beam, 3.0, 0.02);
    e.plant().distance = 0.05;
    Trial& trial = e.trials[0];
    trial.gravity = Vec3(0, 0, -9.81);
    trial.holds.push_back(
        {testing::on_stem(0.8), testing::resting_at(Vec3(0.03, 0, 0.8 * beam.length)), 0.5, 20.0});
    Variant variant;
    variant.effects = {testing::effect("extra_mass", "mass", {hidden_mass})};
    variant.effects[0].place = testing::on_stem(0.75);
    Simulator simulator(e, numerics, 1);
    const Simulator::Request request{&variant, 0};
    const Prediction seen = simulator.run(std::span(&request, 1)).front();
    trial.markers.value = seen.markers;
    trial.force.value = seen.force;
    Random random(3);
    for (double& x : trial.markers.value.reshaped()) x += noise * random.normal();
    for (double& x : trial.force.value.reshaped()) x += 1.0e-3 * random.normal();
    return e;
  }
};

TEST(Continuation, FindsTheMassThatPulledDensity) {
  Weighted weighted;
  ASSERT_TRUE(has_prior_shift(weighted.base.hypothesis, {}));
  EXPECT_TRUE(likest_continuations(weighted.base, "latency", weighted.directions, {}).empty());
  const auto starts = likest_continuations(weighted.base, "extra_mass", weighted.directions, {});
  ASSERT_FALSE(starts.empty());
  const auto found =
      continue_to_prior(weighted.evaluator, weighted.base, starts.front(), weighted.options);
  ASSERT_TRUE(found);
  const Hypothesis& model = found->hypothesis;
  // Density and the mass stand for each other: the prior's tenth leaves the mass open to a tenth
  // of the beam's.
  EXPECT_NEAR(model.value(model.factor_on("density")), 1.0, 0.2);
  EXPECT_NEAR(model.value(model.size() - 1), hidden_mass, 0.3 * hidden_mass);
  EXPECT_NEAR(model.effects.back().place->at, 0.75, 0.1);
  EXPECT_LT(found->cost, weighted.base.cost + 10.0);
}

// Density is known to 0.1 of its logarithm: 1.4 is 3.4 deviations away, 1.6 is 4.7. Modulus is
// known to 1.5: only its bound is too far. Damping may end there.
TEST(Continuation, BeyondBelief) {
  FitSummary model;
  model.hypothesis = baseline();
  Hypothesis& numbers = model.hypothesis;
  const int modulus = numbers.factor_on("youngs_modulus"), density = numbers.factor_on("density");
  numbers.set_value(modulus, 9.0);
  numbers.set_value(density, 1.4);
  model.at_bound = {numbers.factor_on("damping_time")};
  EXPECT_FALSE(conflicts_with_prior(model, {}));
  model.at_bound = {modulus};
  EXPECT_TRUE(conflicts_with_prior(model, {}));
  model.at_bound.clear();
  numbers.set_value(density, 1.6);
  EXPECT_TRUE(conflicts_with_prior(model, {}));
  const Hypothesis believed = at_prior(numbers);
  for (int p = 0; p < believed.size(); ++p) EXPECT_NEAR(believed.value(p), 1.0, 1e-12);
}

TEST(Continuation, IsNotGoneWhereNothingIsPulled) {
  Weighted weighted;
  weighted.base.hypothesis.set_value(weighted.base.hypothesis.factor_on("density"), 1.04);
  EXPECT_FALSE(has_prior_shift(weighted.base.hypothesis, {}));
  EXPECT_TRUE(likest_continuations(weighted.base, "extra_mass", weighted.directions, {}).empty());
}

}  // namespace
}  // namespace pedicel::discrepancy
