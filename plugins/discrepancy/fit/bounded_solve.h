#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <string>

namespace pedicel::discrepancy {

struct BoundedSolution {
  bool converged = false;
  std::string why;  ///< why it stopped, Ceres's words
};

/// Least squares within bounds from `u`, which is moved to the minimum. Ceres cuts a step that
/// leaves the bounds back onto them, which may go up instead of down: along a curved valley beside
/// a bound it stays where it is. So an unknown at whose bound steps are refused is held there until
/// the others have converged, and freed again if the cost falls inwards (an active set: Nocedal &
/// Wright, Numerical Optimization, section 16.5). All rounds share `settings`' iterations.
BoundedSolution solve_bounded(const ceres::CostFunction& cost, const Eigen::VectorXd& low,
                              const Eigen::VectorXd& high, ceres::Solver::Options settings,
                              Eigen::VectorXd& u);

}  // namespace pedicel::discrepancy
