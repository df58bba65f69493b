#include "plugins/discrepancy/fit/bounded_solve.h"

#include <gtest/gtest.h>

namespace pedicel::discrepancy {
namespace {

// A valley e = -m, along which m = h(g) = 2 + g - g^2/2 and g slides towards 3. It leads to
// g 3, m 0.5, e -0.5; but from g 0 the first step would have m grow beyond its bound, 2.
constexpr double steep = 1.0e4;
class BentValley : public ceres::SizedCostFunction<3, 3> {
 public:
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const double e = parameters[0][0], m = parameters[0][1], g = parameters[0][2];
    residuals[0] = steep * (e + m);
    residuals[1] = m - (2.0 + g - 0.5 * g * g);
    residuals[2] = 0.3 * (g - 3.0);
    if (!jacobians || !jacobians[0]) return true;
    const double rows[] = {steep, steep, 0.0, 0.0, 1.0, g - 1.0, 0.0, 0.0, 0.3};
    std::copy(std::begin(rows), std::end(rows), jacobians[0]);
    return true;
  }
};

ceres::Solver::Options few_steps() {
  ceres::Solver::Options settings;
  settings.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  settings.max_num_iterations = 60;
  settings.max_num_line_search_step_size_iterations = 1;
  settings.logging_type = ceres::SILENT;
  return settings;
}

TEST(BoundedSolve, AValleyBesideABoundIsFollowed) {
  Eigen::VectorXd u = Eigen::Vector3d(-2.0, 2.0, 0.0);
  const BoundedSolution found = solve_bounded(BentValley(), Eigen::Vector3d(-10, 0, -10),
                                              Eigen::Vector3d(10, 2, 10), few_steps(), u);
  EXPECT_TRUE(found.converged) << found.why;
  EXPECT_LT((u - Eigen::Vector3d(-0.5, 0.5, 3.0)).norm(), 1e-4) << u.transpose();
}

// The minimum within the bounds, m at most 0.2: there the cost falls outwards alone.
TEST(BoundedSolve, AMinimumAtABoundStaysThere) {
  Eigen::VectorXd u = Eigen::Vector3d(0.0, 0.1, 2.5);
  const BoundedSolution found = solve_bounded(BentValley(), Eigen::Vector3d(-10, 0, -10),
                                              Eigen::Vector3d(10, 0.2, 10), few_steps(), u);
  EXPECT_TRUE(found.converged) << found.why;
  EXPECT_EQ(u[1], 0.2);
  const double g = u[2], slope = (0.2 - 2.0 - g + 0.5 * g * g) * (g - 1.0) + 0.09 * (g - 3.0);
  EXPECT_NEAR(slope, 0.0, 1e-4);
  EXPECT_NEAR(u[0], -0.2, 1e-6);
}

}  // namespace
}  // namespace pedicel::discrepancy
