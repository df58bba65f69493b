#include "plugins/discrepancy/fit/bounded_solve.h"

#include <algorithm>
#include <vector>

namespace pedicel::discrepancy {

namespace {

// Each round holds unknowns or frees them. An unknown on the edge of its bound could be held and
// freed for ever.
constexpr int most_rounds = 5;
constexpr double near = 1.0e-3;  // of an unknown, to its bound: refused steps end just before it

std::vector<int> at_bounds(const Eigen::VectorXd& u, const Eigen::VectorXd& low,
                           const Eigen::VectorXd& high) {
  std::vector<int> found;
  // All that stand there, not the one whose step was refused: Ceres refuses a step as a whole, and
  // does not tell on whose account.
  for (int p = 0; p < u.size(); ++p)
    if (u[p] - low[p] < near || high[p] - u[p] < near) found.push_back(p);
  return found;
}

// Ends a round where a step was refused beside a bound.
class RefusedAtBound : public ceres::IterationCallback {
 public:
  RefusedAtBound(const Eigen::VectorXd& u, const Eigen::VectorXd& low, const Eigen::VectorXd& high)
      : u_(u), low_(low), high_(high) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    // A refused step in the open is no reason: there the trust region shrinks, and the fit goes on.
    // The zeroth iteration is the start itself, which was not a step.
    happened =
        summary.iteration > 0 && !summary.step_is_successful && !at_bounds(u_, low_, high_).empty();
    return happened ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  bool happened = false;

 private:
  const Eigen::VectorXd &u_, &low_, &high_;
};

}  // namespace

BoundedSolution solve_bounded(const ceres::CostFunction& cost, const Eigen::VectorXd& low,
                              const Eigen::VectorXd& high, ceres::Solver::Options settings,
                              Eigen::VectorXd& u) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  // Ceres only reads it, but asks for a pointer to something that it may own.
  problem.AddResidualBlock(const_cast<ceres::CostFunction*>(&cost), nullptr, u.data());
  const int n = static_cast<int>(u.size());
  for (int p = 0; p < n; ++p) {
    problem.SetParameterLowerBound(u.data(), p, low[p]);
    problem.SetParameterUpperBound(u.data(), p, high[p]);
  }
  const auto falls_inwards = [&](const std::vector<int>& held) {
    // With all unknowns free: a gradient that leaves the held ones out could not speak for them.
    problem.SetManifold(u.data(), nullptr);
    std::vector<double> gradient;
    problem.Evaluate({}, nullptr, nullptr, &gradient, nullptr);
    // Ceres's gradient is that of the cost. It falls inwards where it falls upwards from the low
    // bound, or downwards from the high one. These are the signs of the multipliers of a minimum at
    // a bound.
    return std::ranges::any_of(
        held, [&](int p) { return u[p] <= low[p] ? gradient[p] < 0.0 : gradient[p] > 0.0; });
  };
  RefusedAtBound refused(u, low, high);
  // Else the callback would look at where the round began, and see no bound.
  settings.update_state_every_iteration = true;
  BoundedSolution result;
  std::vector<int> held;
  for (int round = 0; round < most_rounds; ++round) {
    settings.callbacks.clear();
    // While something is held the others go on to the end, whatever is refused beside other bounds.
    // The last round runs to the end, too, so that a fit never ends because of this rule.
    if (held.empty() && round + 1 < most_rounds) settings.callbacks.push_back(&refused);
    problem.SetManifold(u.data(), held.empty() ? nullptr : new ceres::SubsetManifold(n, held));
    ceres::Solver::Summary summary;
    refused.happened = false;
    ceres::Solve(settings, &problem, &summary);
    // A round that was ended for a bound is a success by its own word and has not converged. The
    // next round says.
    result.converged = summary.termination_type == ceres::CONVERGENCE;
    result.why = summary.message;
    // The first entry is the start. A round counts one at least, so that rounds that do nothing
    // end.
    settings.max_num_iterations -= std::max(1, static_cast<int>(summary.iterations.size()) - 1);
    if (settings.max_num_iterations <= 0) break;
    if (refused.happened) {
      held = at_bounds(u, low, high);
      // Onto the bound itself: refused steps end just before it, and what is held there stays
      // there.
      for (const int p : held) u[p] = u[p] - low[p] < near ? low[p] : high[p];
      // All are freed together. Which of them keeps the cost from falling is found again by the
      // next refusal, in one round.
    } else if (!held.empty() && falls_inwards(held)) {
      held.clear();
    } else {
      break;
    }
    // With all held nothing is left to fit. A corner is where it ends.
    if (static_cast<int>(held.size()) == n) break;
  }
  return result;
}

}  // namespace pedicel::discrepancy
