// Derivatives by differences of a prediction in closed form.
#include "plugins/discrepancy/simulate/differences.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/discrepancy/fit/causes.h"

namespace pedicel::discrepancy {
namespace {

// A swing at sqrt(modulus / density) that goes on for 50 rad, in noise units, and a sag that
// density alone adds to: by `sag` in all.
Eigen::VectorXd prediction(const Hypothesis& model, double sag) {
  const double modulus = model.value(model.factor_on("youngs_modulus"));
  const double density = model.value(model.factor_on("density"));
  const double damping = model.value(model.factor_on("damping_time"));
  Eigen::VectorXd samples(500);
  for (int i = 0; i < samples.size(); ++i) {
    const double t = 0.1 * i;
    samples[i] = 20.0 * std::exp(-0.02 * damping * t) * std::cos(std::sqrt(modulus / density) * t) +
                 sag / std::sqrt(500.0) * density;
  }
  return samples;
}

Eigen::MatrixXd residuals(const std::vector<Hypothesis>& points, double sag) {
  Eigen::MatrixXd r(500, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    r.col(static_cast<Eigen::Index>(i)) = -prediction(points[i], sag);
  return r;
}

// Modulus and density by the same factor change the sag alone: d / d ln density = sag. By one at a
// time, differences of a swing so long are wrong by more than that.
TEST(Differences, KeepApartWhatDensityDoesBesideModulus) {
  const double sag = 2.0;
  Differences differences(baseline());
  Eigen::MatrixXd jacobian;
  for (int pass = 0; pass < 2; ++pass)
    jacobian = differences.jacobian(residuals(differences.points(baseline().unknowns()), sag));
  const Hypothesis model = baseline();
  const Eigen::VectorXd both =
      jacobian.col(model.factor_on("youngs_modulus")) + jacobian.col(model.factor_on("density"));
  EXPECT_NEAR(both.norm(), sag, 0.05 * sag);
  EXPECT_LT((both.array() - sag / std::sqrt(500.0)).matrix().norm(), 0.05 * sag);

  const double step = 1e-3;
  Hypothesis modulus = model, density = model;
  modulus.set_value(modulus.factor_on("youngs_modulus"), std::exp(step));
  density.set_value(density.factor_on("density"), std::exp(step));
  const Eigen::VectorXd apart =
      (prediction(modulus, sag) + prediction(density, sag) - 2.0 * prediction(model, sag)) / step;
  EXPECT_GT((apart.array() - sag / std::sqrt(500.0)).matrix().norm(), sag);
}

TEST(Differences, StayWithinBounds) {
  const Hypothesis model = baseline();
  Differences differences(model);
  for (const Hypothesis& point : differences.points(model.high())) {
    EXPECT_TRUE((point.unknowns().array() <= model.high().array() + 1e-12).all());
    EXPECT_EQ(point.size(), model.size());
  }
  // Each but the first is moved.
  const auto points = differences.points(model.high());
  for (std::size_t i = 1; i < points.size(); ++i)
    EXPECT_GT((points[i].unknowns() - model.high()).norm(), 1e-5);
}

// A first guess of one in a hundred turns this swing by a quarter of a radian: in noise a tenth as
// large, that is 40 times what is wanted. Sizes from known derivatives are right at once, also of
// the first unknowns alone.
TEST(Differences, AreSuitedOnceDerivativesAreKnown) {
  const Hypothesis model = baseline();
  const auto seen = [](const std::vector<Hypothesis>& points) -> Eigen::MatrixXd {
    return 10.0 * residuals(points, 2.0);
  };
  Differences guessed(model);
  const Eigen::MatrixXd jacobian = guessed.jacobian(seen(guessed.points(model.unknowns())));
  EXPECT_FALSE(guessed.suited());
  Differences known(model, jacobian), partly(model, jacobian.leftCols(2));
  const auto points = known.points(model.unknowns()), first = partly.points(model.unknowns());
  for (int p = 0; p < 2; ++p) EXPECT_EQ(points[p + 1].unknowns(), first[p + 1].unknowns());
  known.jacobian(seen(points));
  EXPECT_TRUE(known.suited());
}

}  // namespace
}  // namespace pedicel::discrepancy
