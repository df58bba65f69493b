// A place lies in a narrow valley: a fit that stopped elsewhere must be led to it.
#include "plugins/discrepancy/select/place_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/profile.h"
#include "plugins/effects/registry/effect_definition.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 2.0e-4;       // m
constexpr double hidden_mass = 0.004;  // kg, of the beam's 9 g
constexpr double hidden_at = 0.75;
constexpr double hidden_distance = 0.02, hidden_moment = 0.6;  // m, s
constexpr Numerics numerics{0.05, 1.0 / 240.0};

// What the effect makes of a beam that is held until `release` (s).
Experiment held_beam(const plant::Effect& effect, double release) {
  testing::Beam beam;
  beam.damping_time = 0.01;
  Experiment e = testing::experiment_of(beam, 1.0, 0.02);
  e.plant().distance = 0.05;
  Trial& trial = e.trials[0];
  trial.force = {};
  trial.gravity = Vec3(0, 0, -9.81);
  trial.holds.push_back({testing::on_stem(0.8),
                         testing::resting_at(Vec3(0.03, 0, 0.8 * beam.length)), release, 20.0});
  Variant variant;
  variant.effects = {effect};
  Simulator simulator(e, numerics, 1);
  const Simulator::Request request{&variant, 0};
  trial.markers.value = simulator.run(std::span(&request, 1)).front().markers;
  return e;
}

plant::Effect mass() {
  plant::Effect effect = testing::effect("extra_mass", "mass", {hidden_mass});
  effect.place = testing::on_stem(hidden_at);
  return effect;
}

plant::Effect slip() {
  plant::Effect effect = testing::effect("grip_slip", "distance", {hidden_distance});
  effect.numbers["time"] = {hidden_moment};
  return effect;
}

struct Slid {
  Experiment experiment;
  DataSet data{experiment};
  Simulator simulator{experiment, numerics, 1};
  Evaluator evaluator{simulator, data};
  FitOptions options;

  explicit Slid(Experiment made = held_beam(mass(), 0.3)) : experiment(std::move(made)) {
    data.set_noise(white_noise(noise), white_noise(1.0));
    options.trials = {0};
  }
  FitSummary fitted(const Hypothesis& added, int iterations) {
    Hypothesis start = baseline();
    start.add(added);
    FitOptions so_far = options;
    so_far.iterations = iterations;
    return fit(evaluator, start, so_far);
  }
  FitSummary stopped_early(const Hypothesis& added) { return fitted(added, 0); }
};

TEST(PlaceSearch, LeadsAMassAlongTheCurve) {
  Slid slid;
  const FitSummary early = slid.stopped_early(
      effects::Start("extra_mass").moving_place("stem", 0.4).positive("mass", 0.008, 1e-5, 0.3));
  ASSERT_LT(early.hypothesis.effects.back().place->at, 0.6);
  const FitSummary found = slide_along(slid.evaluator, early, slid.options);
  EXPECT_NEAR(found.hypothesis.effects.back().place->at, hidden_at, 0.02);
  EXPECT_NEAR(found.hypothesis.value(found.hypothesis.size() - 1), hidden_mass, 0.1 * hidden_mass);
  EXPECT_LT(objective(found), 0.1 * objective(early));
}

// A slip of a hundred noise units moves all samples after it: in the wrong moment a fit sees no
// farther than the next sample.
TEST(PlaceSearch, LeadsASlipToItsMoment) {
  Slid slid(held_beam(slip(), std::numeric_limits<double>::infinity()));
  const FitSummary stuck = slid.fitted(effects::Start("grip_slip")
                                           .signed_number("distance", 0.01, 0.01, -0.1, 0.1)
                                           .signed_number("time", 0.3, 0.2, 0.0, 1.0),
                                       30);
  const int time = stuck.hypothesis.size() - 1;
  ASSERT_GT(std::abs(stuck.hypothesis.value(time) - hidden_moment), 0.04);  // two samples
  const FitSummary found = slide_along(slid.evaluator, stuck, slid.options);
  EXPECT_NEAR(found.hypothesis.value(time), hidden_moment, 0.005);  // a quarter of a sample
  EXPECT_NEAR(found.hypothesis.value(time - 1), hidden_distance, 0.01 * hidden_distance);
}

TEST(PlaceSearch, LeavesAFitWithoutPlaceAsItIs) {
  Slid slid;
  const FitSummary early = slid.stopped_early(
      effects::Start("mass_distribution").signed_number("gradient", 0.2, 0.3, -1.9, 1.9));
  const FitSummary found = slide_along(slid.evaluator, early, slid.options);
  EXPECT_EQ(found.hypothesis.unknowns(), early.hypothesis.unknowns());
}

}  // namespace
}  // namespace pedicel::discrepancy
