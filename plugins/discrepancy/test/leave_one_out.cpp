#include "pedicel/discrepancy/test/leave_one_out.h"

namespace pedicel::discrepancy {

std::vector<LeftOut> leave_one_out(const FitSummary& fit, std::span<const Eigen::Index> rows) {
  Eigen::MatrixXd jacobian = fit.jacobian;
  for (const int p : fit.at_bound) jacobian.col(p).setZero();
  const PriorRows prior = prior_rows(fit);
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  const Eigen::VectorXd pull = jacobian.transpose() * fit.residual;
  std::vector<LeftOut> result;
  Eigen::Index row = 0;
  for (const Eigen::Index count : rows) {
    const auto here = jacobian.middleRows(row, count);
    const auto residual = fit.residual.segment(row, count);
    Eigen::MatrixXd rest = information - here.transpose() * here;
    rest += prior.weight.cwiseAbs2().asDiagonal();
    const Eigen::VectorXd gradient =
        pull - here.transpose() * residual + prior.weight.cwiseProduct(prior.left);
    // What only the trial left out shows stays.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
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
