// Our own numerical error on a released beam. Step and mesh err by the second power of their size:
// halving the step must quarter what half a step more would change, and what Richardson's
// correction leaves must be far below what it corrects.
#include "plugins/discrepancy/fit/numerics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 1.0e-4;  // m

/// Held aside by 30 mm, let go after 0.05 s; its own damping is strong, so that coarse steps have
/// something to resolve and nothing to alias.
struct Released {
  Experiment experiment;
  DataSet data;
  FitOptions options;
  FitSummary base;

  explicit Released(double distance = 0.08, bool branched = false)
      : experiment(made(distance, branched)), data(experiment) {
    data.set_noise(white_noise(noise), white_noise(1.0));
    options.trials = {0};
  }
  static Experiment made(double distance, bool branched) {
    testing::Beam beam;
    beam.damping_time = 0.02;
    Experiment e = testing::experiment_of(beam, 0.4);
    e.plant().distance = distance;
    if (branched) {
      plant::PlantCurve branch = e.plant().curves[0];
      branch.name = "branch";
      branch.points = {Vec3(0, 0, 0.5 * beam.length), Vec3(0.12, 0, 0.6 * beam.length)};
      e.plant().curves.push_back(branch);
    }
    Trial& trial = e.trials[0];
    trial.force = {};
    Hold hold;
    hold.place = testing::on_stem(1.0);
    hold.path = testing::resting_at(Vec3(0.03, 0, beam.length));
    hold.release = 0.05;
    hold.stiffness = 50.0;
    trial.holds.push_back(hold);
    return e;
  }
  NumericsCheck check(const Numerics& numerics) const {
    long simulations = 0;
    NumericsCheck found = check_numerics(experiment, data, base, numerics, options, 1, simulations);
    EXPECT_GE(simulations, 4);
    return found;
  }
  /// RMS in noise units from a far finer simulation.
  double error(const Numerics& numerics, const Corrections* corrections) const {
    Simulator finest(experiment, {0.005, 1.0 / 3840.0}, 1), coarse(experiment, numerics, 1);
    const Hypothesis plain;
    const auto of = [&](Simulator& simulator, const Corrections* with) {
      Evaluator evaluator(simulator, data, with);
      return evaluator.predictions(std::span(&plain, 1), options).front().front().markers;
    };
    const Eigen::MatrixXd off = of(coarse, corrections) - of(finest, nullptr);
    return off.norm() / std::sqrt(static_cast<double>(off.size())) / noise;
  }
};

TEST(NumericsCheck, OfHalfTheStepIsAQuarter) {
  const Released beam;
  const double coarse = beam.check({0.04, 1.0 / 240.0}).by_step;
  const double fine = beam.check({0.04, 1.0 / 480.0}).by_step;
  EXPECT_GT(coarse, 0.05);
  EXPECT_NEAR(coarse / fine, 4.0, 0.8);
}

// What a coarser mesh does to a beam another modulus does, too: the shift stands for nearly all.
TEST(NumericsCheck, OfHalfTheMeshIsAQuarter) {
  const Released beam;
  const auto shift = [&](double distance) {
    return beam.check({distance, 1.0 / 960.0}).corrections.own.shift.logarithm[0];
  };
  const double coarse = shift(0.04);
  EXPECT_GT(std::abs(coarse), 1.0e-4);
  EXPECT_NEAR(coarse / shift(0.02), 4.0, 0.8) << coarse << " from " << shift(0.08);
}

TEST(NumericsCheck, CorrectsWhatItFinds) {
  const Released beam;
  const Numerics numerics{0.04, 1.0 / 240.0};
  const NumericsCheck check = beam.check(numerics);
  const double before = beam.error(numerics, nullptr);
  EXPECT_GT(before, 0.5);
  EXPECT_LT(beam.error(numerics, &check.corrections), 0.15 * before);
}

// Nodes twice as far apart as in the plant file, where a branch meets its stem.
TEST(NumericsCheck, CorrectsAMeshCoarserThanTheFiles) {
  const Released plant(0.02, true);
  const Numerics numerics{0.04, 1.0 / 960.0};
  const NumericsCheck check = plant.check(numerics);
  const double before = plant.error(numerics, nullptr);
  const double after = plant.error(numerics, &check.corrections);
  EXPECT_GT(before, 0.2);
  EXPECT_LT(after, 0.05 * before) << after << " of " << before;
}

TEST(Refined, HalvesWhatWeighsMore) {
  NumericsCheck check;
  check.numerics = {0.04, 0.01};
  const auto next = [&](double by_step, double by_mesh) {
    check.by_step = by_step, check.by_mesh = by_mesh;
    const Numerics finer = refined(check);
    return std::pair(finer.distance, finer.dt);
  };
  EXPECT_EQ(next(1.0, 0.4), std::pair(0.04, 0.005));
  EXPECT_EQ(next(0.4, 1.0), std::pair(0.02, 0.01));
  EXPECT_EQ(next(1.0, 0.6), std::pair(0.02, 0.005));
}

}  // namespace
}  // namespace pedicel::discrepancy
