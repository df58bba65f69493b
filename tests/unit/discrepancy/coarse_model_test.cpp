// The coarse model of searches: it must agree with the fine one where it is anchored, follow it
// near by, and give way to the fine one where it would be wrong by much of the noise.
#include "plugins/discrepancy/fit/coarse_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/discrepancy/fit/causes.h"
#include "tests/unit/discrepancy/released_beam.h"

namespace pedicel::discrepancy {
namespace {

struct Fitted {
  Experiment experiment;
  FitSetup setup;
  FitSummary model;

  explicit Fitted(double noise)
      : experiment(testing::released_beam(noise, 0.04, {0.04, 1.0 / 480.0})),
        setup(experiment, 1, {}, nullptr, default_settings()) {
    Evaluator evaluator = setup.evaluator();
    model = fit(evaluator, baseline(), setup.options());
    setup.refine(model, {[](int) {}, {}});
    setup.renew();
    Evaluator corrected = setup.evaluator();
    model.hypothesis.add(mesh_nuisance());
    model = fit(corrected, model.hypothesis, setup.options());
  }
  Eigen::MatrixXd seen(Evaluator evaluator, const Hypothesis& of) const {
    return evaluator.predictions(std::span(&of, 1), setup.options()).front().front().markers;
  }
};

// RMS, m.
double rms(const Eigen::MatrixXd& difference) {
  return difference.norm() / std::sqrt(static_cast<double>(difference.size()));
}

TEST(CoarseModel, AgreesWithTheFineOneAtItsAnchor) {
  Fitted fitted(3.0e-4);
  CoarseModel coarse(fitted.setup, fitted.model);
  EXPECT_EQ(coarse.numerics().distance, 2.0 * fitted.setup.numerics().distance);
  EXPECT_EQ(coarse.numerics().dt, 2.0 * fitted.setup.numerics().dt);
  EXPECT_EQ(coarse.workers().size(), 1u);
  const Hypothesis& anchor = fitted.model.hypothesis;
  const Eigen::MatrixXd fine = fitted.seen(fitted.setup.evaluator(), anchor);
  EXPECT_LT(rms(fitted.seen(coarse.evaluator(), anchor) - fine), 1e-9);
  EXPECT_LT(rms(fitted.seen(coarse.workers().front(), anchor) - fine), 1e-9);
}

// The error of a coarse prediction is e(p); carried along is e(p0). What is left near by is
// e'(p0) dp: for a modulus 2 % higher, of errors of second order in the step times the frequency,
// a part of the order of 2 % times the number of radians swung, here about 30, and the shift of the
// parameters takes that. Without any correction all of e(p) would be left.
TEST(CoarseModel, FollowsTheFineOneNearItsAnchor) {
  Fitted fitted(3.0e-4);
  CoarseModel coarse(fitted.setup, fitted.model);
  Hypothesis near_by = fitted.model.hypothesis;
  const int modulus = near_by.factor_on("youngs_modulus");
  near_by.set_value(modulus, 1.02 * near_by.value(modulus));
  const Eigen::MatrixXd fine = fitted.seen(fitted.setup.evaluator(), near_by);
  Simulator plain(fitted.experiment, coarse.numerics(), 1);
  const double uncorrected =
      rms(fitted.seen(Evaluator(plain, fitted.setup.data()), near_by) - fine);
  EXPECT_LT(rms(fitted.seen(coarse.evaluator(), near_by) - fine), 0.1 * uncorrected);
}

TEST(CoarseModel, IsNoCoarserThanTheNoiseAllows) {
  Fitted fitted(2.0e-6);
  CoarseModel coarse(fitted.setup, fitted.model);
  EXPECT_LT(coarse.error(), 0.4);
  const Numerics twice{2.0 * fitted.setup.numerics().distance, 2.0 * fitted.setup.numerics().dt};
  EXPECT_TRUE(coarse.numerics().distance < twice.distance || coarse.numerics().dt < twice.dt);
}

// Where the noise lets the fit itself go by twice the file's mesh, a search does not go by four
// times: a weak stretch may be shorter than such a segment.
TEST(CoarseModel, IsNoCoarserThanTwiceTheFilesMesh) {
  Fitted fitted(5.0e-3);
  const double most = 2.0 * fitted.experiment.plant().distance;
  ASSERT_EQ(fitted.setup.numerics().distance, most);
  CoarseModel coarse(fitted.setup, fitted.model);
  EXPECT_EQ(coarse.numerics().distance, most);
  EXPECT_EQ(coarse.numerics().dt, 2.0 * fitted.setup.numerics().dt);
}

}  // namespace
}  // namespace pedicel::discrepancy
