// Mesh, step and corrections that an experiment is fitted with: as coarse as its noise allows, and
// right about the model that they are asked for.
#include "plugins/discrepancy/fit/fit_setup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/discrepancy/fit/causes.h"
#include "tests/unit/discrepancy/released_beam.h"

namespace pedicel::discrepancy {
namespace {

constexpr double file_distance = 0.04, usual_dt = 1.0 / 480.0;
constexpr Numerics finest{0.005, 1.0 / 3840.0};

/// Released, its noise stated.
Experiment stated(double noise, double distance) {
  Experiment e = testing::released_beam(noise, distance, {0.02, 1.0 / 960.0});
  e.noise.position_std = noise;
  return e;
}

struct Refined {
  Experiment experiment;
  FitSetup setup;
  FitSummary model;
  NumericsCheck check;

  explicit Refined(double noise, double distance = file_distance)
      : experiment(stated(noise, distance)), setup(experiment, 1, {}, nullptr, default_settings()) {
    Evaluator evaluator = setup.evaluator();
    model = fit(evaluator, baseline(), setup.options());
    check = setup.refine(model, {[](int) {}, {}});
    setup.renew();
  }
  // RMS of a corrected prediction from one that is far finer, m.
  double error_at(const Hypothesis& hypothesis) {
    Simulator simulator(experiment, finest, 1);
    const auto markers = [&](Evaluator evaluator) {
      return evaluator.predictions(std::span(&hypothesis, 1), setup.options())
          .front()
          .front()
          .markers;
    };
    const Eigen::MatrixXd off =
        markers(setup.evaluator()) - markers(Evaluator(simulator, setup.data()));
    return off.norm() / std::sqrt(static_cast<double>(off.size()));
  }
};

TEST(FitSetup, IsCoarserThanTheFileWhereTheNoiseHidesIt) {
  const Refined noisy(3.0e-3);
  EXPECT_EQ(noisy.setup.numerics().distance, 2.0 * file_distance);
  EXPECT_EQ(noisy.setup.numerics().dt, 2.0 * usual_dt);
  EXPECT_LE(noisy.check.largest, 0.06);
}

TEST(FitSetup, IsRefinedUntilTheNoiseHidesIt) {
  const Refined precise(3.0e-5);
  EXPECT_LE(precise.check.largest, 0.15);
  EXPECT_LT(precise.setup.numerics().dt, 2.0 * usual_dt);
}

// A coarse mesh beside very short steps would be neither cheap nor what has been measured. On a
// fine mesh it is the steps that err: 0.088 of this noise at 1/480 s, the mesh a third of that.
TEST(FitSetup, IsNotFinerInOneThanUsualWhileCoarserInTheOther) {
  constexpr double fine = 0.125 * file_distance;
  const Refined refined(3.0e-5, fine);
  EXPECT_EQ(refined.setup.numerics().distance, fine);
  EXPECT_EQ(refined.setup.numerics().dt, usual_dt);
}

// Twice the modulus swings 1.4 times as fast: coarse steps meet that worse, and what is carried
// over from the model before is out of phase. Corrected there, the error is of a higher order in
// step and mesh (0.17 mm before, 0.019 mm after).
TEST(FitSetup, CorrectsAboutAModelFarAway) {
  Refined refined(3.0e-3);
  Hypothesis far = refined.model.hypothesis;
  far.set_value(far.factor_on("youngs_modulus"), 2.0);
  const double before = refined.error_at(far);
  Evaluator evaluator = refined.setup.evaluator();
  FitOptions none = refined.setup.options();
  none.iterations = 0;
  refined.setup.correct_at(fit(evaluator, far, none));
  EXPECT_LT(refined.error_at(far), 0.3 * before) << before;
}

// A modulus of 16 swings four times as fast. Where that model explains the data, steps that were
// fine enough for the one before no longer are; where it misses them by far more than our own
// error, nothing is gained by finer ones.
TEST(FitSetup, GetsFinerAboutAModelFarAwayOnlyWhereThatExplainsTheData) {
  Refined refined(3.0e-4);
  const Numerics before = refined.setup.numerics();
  Hypothesis far = refined.model.hypothesis;
  far.set_value(far.factor_on("youngs_modulus"), 16.0);
  Evaluator evaluator = refined.setup.evaluator();
  FitOptions none = refined.setup.options();
  none.iterations = 0;
  FitSummary model = fit(evaluator, far, none);
  ASSERT_GT(2.0 * model.cost, 100.0 * refined.setup.samples());
  refined.setup.correct_at(model);
  EXPECT_EQ(refined.setup.numerics(), before);

  model.cost = 0.5 * refined.setup.samples();
  refined.setup.correct_at(model);
  EXPECT_LT(refined.setup.numerics().dt, before.dt);
}

}  // namespace
}  // namespace pedicel::discrepancy
