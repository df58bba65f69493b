#include "plugins/discrepancy/test/leave_one_out.h"

namespace pedicel::discrepancy {

std::vector<LeftOut> leave_one_out(const FitSummary& fit, std::span<const Eigen::Index> rows) {
  Eigen::MatrixXd jacobian = fit.jacobian;
  // A number at its bound would be moved beyond it. Without its column it neither moves nor is
  // asked.
  for (const int p : fit.at_bound) jacobian.col(p).setZero();
  const PriorRows prior = prior_rows(fit);
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  // At the end of a fit the pulls of all trials and of the prior balance. Without one trial they do
  // not, and what is left is the step.
  const Eigen::VectorXd pull = jacobian.transpose() * fit.residual;
  std::vector<LeftOut> result;
  Eigen::Index row = 0;
  for (const Eigen::Index count : rows) {
    const auto here = jacobian.middleRows(row, count);
    const auto residual = fit.residual.segment(row, count);
    Eigen::MatrixXd rest = information - here.transpose() * here;
    // What is known beforehand stays known, whichever trial is left out.
    rest += prior.weight.cwiseAbs2().asDiagonal();
    const Eigen::VectorXd gradient =
        pull - here.transpose() * residual + prior.weight.cwiseProduct(prior.left);
    // What only the trial left out shows stays.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    // Of the largest pivot: below it a direction is open, and the least step leaves it as it is.
    solver.setThreshold(1e-11);
    LeftOut without;
    without.moved = solver.compute(rest).solve(gradient);
    for (const int p : fit.at_bound) without.moved[p] = 0.0;
    without.cost = 0.5 * ((fit.residual - jacobian * without.moved).squaredNorm() -
                          (residual - here * without.moved).squaredNorm());
    result.push_back(without);
    row += count;
  }
  return result;
}

}  // namespace pedicel::discrepancy
