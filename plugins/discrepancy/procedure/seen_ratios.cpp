#include "plugins/discrepancy/procedure/seen_ratios.h"

#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double closely = 0.2;  // of the error of either of the two
constexpr double loose = 0.02;   // standard deviation below which either is known well enough

// Covariance of the unknowns, what is known of them beforehand included.
Eigen::MatrixXd covariance(const FitSummary& fit) {
  Eigen::MatrixXd information = fit.jacobian.transpose() * fit.jacobian;
  information.diagonal() += prior_rows(fit).weight.cwiseAbs2();
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

void report_ratios(const Findings& findings, Diagnosis& diagnosis) {
  const FitSummary& fit = diagnosis.best;
  if (fit.jacobian.cols() != fit.hypothesis.size()) return;
  const Eigen::MatrixXd c = covariance(fit);
  const Shift::Names& names = Shift::names();
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = i + 1; k < names.size(); ++k) {
      const int a = fit.hypothesis.factor_on(names[i]);
      const int b = fit.hypothesis.factor_on(names[k]);
      if (a < 0 || b < 0) continue;
      // The unknowns are logarithms of factors.
      const double each = std::sqrt(std::min(c(a, a), c(b, b)));
      const double both = std::sqrt(std::max(0.0, c(a, a) + c(b, b) - 2.0 * c(a, b)));
      if (!(each > loose) || both > closely * each) continue;
      const double value = fit.hypothesis.value(a) / fit.hypothesis.value(b);
      const double error = std::exp(interval95 * both * findings.spread(fit));
      diagnosis.verdict.ratios[names[i] + "/" + names[k]] = {value, value / error, value * error,
                                                             "1"};
    }
}

}  // namespace pedicel::discrepancy
