#include "plugins/discrepancy/test/held_out.h"

#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/simulate/differences.h"

namespace pedicel::discrepancy {

namespace {

// A model with its unknowns moved as far as the held-out trials ask for and the fit allows.
struct Moved {
  Eigen::VectorXd residual;
  double square = 0.0;  // what it leaves, weighed by its predictive covariance
  double cost = 0.0;    // minus the log predictive density, but for a constant
};

Moved moved(const HeldOutModel& model, double fitted_dispersion, double dispersion) {
  // Bayes' rule for a linear model: the unknowns have a normal density from the fitted trials, and
  // the held-out ones are predicted with it. Integrating over the unknowns is the same as moving
  // them as far as both allow, and paying by the two determinants.
  const Eigen::MatrixXd here = model.jacobian.transpose() * model.jacobian / dispersion;
  Eigen::MatrixXd information = model.by_data / fitted_dispersion;
  // What is known beforehand closes what the fitted trials leave open. Without it the matrix may be
  // singular.
  information.diagonal() += model.prior;
  const Eigen::LLT<Eigen::MatrixXd> before(information), after(information + here);
  const Eigen::VectorXd step =
      after.solve(model.jacobian.transpose() * model.residual / dispersion);
  const auto log_det = [](const Eigen::LLT<Eigen::MatrixXd>& root) {
    // From the factor, since the determinant itself overflows.
    return 2.0 * root.matrixLLT().diagonal().array().log().sum();
  };
  Moved result{model.residual - model.jacobian * step};
  result.square = result.residual.squaredNorm() / dispersion + step.dot(information * step);
  result.cost = 0.5 * (result.square + log_det(after) - log_det(before));
  return result;
}

}  // namespace

// With a change d and a residual d a + noise the gain over the expected one is 2 a - 1, so a share
// of 0.2 stands for an amplitude a of 0.6. Its standard deviation is 2 / |d|.
bool HeldOut::carries_over(const Evidence& evidence) const {
  // The expected gain is half the squared change, so this is its length in noise units.
  const double change = std::sqrt(2.0 * expected);
  if (change < evidence.held_out_change) return true;
  return gain > (evidence.held_out_share - evidence.held_out_chance * 2.0 / change) * expected;
}

HeldOutModel held_out_model(Evaluator& evaluator, const FitSummary& model,
                            const FitOptions& check) {
  // Steps that suit the fitted trials suit these: both are of one plant.
  Differences differences(model.hypothesis, model.jacobian);
  const Eigen::MatrixXd residuals =
      evaluator.residuals(differences.points(model.hypothesis.unknowns()), check);
  HeldOutModel result{residuals.col(0), differences.jacobian(residuals),
                      model.jacobian.transpose() * model.jacobian,
                      Eigen::VectorXd(model.hypothesis.size())};
  for (int p = 0; p < model.hypothesis.size(); ++p)
    result.prior[p] = std::pow(model.hypothesis.free[p].width(), -2);
  return result;
}

double held_out_excess(const HeldOutModel& model, int samples, double dispersion) {
  return moved(model, dispersion, dispersion).square / std::max(1, samples);
}

std::vector<HeldOut> held_out(const HeldOutModel& base, std::span<const HeldOutModel> models,
                              int samples, double dispersion) {
  // The information is of the fitted trials and keeps their scale, while what is left here may be
  // more.
  const double fitted = dispersion;
  double least = base.residual.squaredNorm();
  // What is left depends on how far the unknowns may move, and the other way round.
  // A scale needs few digits, so three passes do. The least over all models is taken, as for the
  // fitted trials.
  for (int pass = 0; pass < 3; ++pass) {
    const double now = std::max(dispersion, least / std::max(1, samples));
    least = moved(base, fitted, now).residual.squaredNorm();
    for (const HeldOutModel& model : models)
      least = std::min(least, moved(model, fitted, now).residual.squaredNorm());
  }
  dispersion = std::max(dispersion, least / std::max(1, samples));
  const Moved without = moved(base, fitted, dispersion);
  std::vector<HeldOut> found;
  for (const HeldOutModel& model : models) {
    const Moved with = moved(model, fitted, dispersion);
    found.push_back({without.cost - with.cost,
                     0.5 * (without.residual - with.residual).squaredNorm() / dispersion});
  }
  return found;
}

}  // namespace pedicel::discrepancy
