#pragma once

#include <span>
#include <vector>

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// A fit without one of its trials, its numbers refitted to the others.
struct LeftOut {
  double cost = 0.0;      ///< 1/2 sum of the squared whitened residuals of the other trials
  Eigen::VectorXd moved;  ///< of the unknowns
};

/// Leaves out each trial in turn: `rows` are the numbers of residuals of the trials, in order. The
/// refit is the step that least squares takes from where the fit ended, what is known beforehand
/// included: exact to first order (Cook 1977, Technometrics 19). Numbers at a bound stay there.
std::vector<LeftOut> leave_one_out(const FitSummary& fit, std::span<const Eigen::Index> rows);

}  // namespace pedicel::discrepancy
